// Checkpoints and photon maps that were changed, and given right checksums: each is refused as a file, or rendered on from to an
// image without NaN or infinity. Nothing else comes of it: no crash, no hang, no error of the device.
#include "base/errors.h"
#include "base/hash.h"
#include "support/cornell_scene.h"
#include "support/render_replicates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <unistd.h>

using namespace sundog;
using namespace sundog::test;

namespace
{

struct Section {
    std::string name, data;
};

// The layout of base/checkpoint_file.h.
constexpr std::size_t file_header_bytes = 16, section_header_bytes = 16, digest_bytes = 16;

template <class T> T number_at(const std::string& bytes, std::size_t offset)
{
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

template <class T> void append_number(std::string& bytes, T value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::vector<Section> sections_of(const std::string& file)
{
    std::vector<Section> sections;
    for (std::size_t at = file_header_bytes; at < file.size();) {
        const auto name_bytes = number_at<std::uint32_t>(file, at);
        const auto data_bytes = number_at<std::uint64_t>(file, at + 8);
        at += section_header_bytes;
        sections.push_back({file.substr(at, name_bytes), file.substr(at + name_bytes, data_bytes)});
        at += name_bytes + data_bytes + digest_bytes;
    }
    return sections;
}

std::string with_right_checksums(const std::string& file_header, const std::vector<Section>& sections)
{
    std::string bytes = file_header;
    for (const Section& section : sections) {
        append_number(bytes, static_cast<std::uint32_t>(section.name.size()));
        append_number(bytes, std::uint32_t(0));
        append_number(bytes, static_cast<std::uint64_t>(section.data.size()));
        bytes += section.name + section.data;
        const Hash hash = Hash().append_field(section.name).append_field(section.data);
        append_number(bytes, hash.low());
        append_number(bytes, hash.high());
    }
    return bytes;
}

// Numbers that are rarely thought of, as 32 and 64 bits: floats and counts.
constexpr std::uint32_t words[] = {0,          1,          2,          0x7fc00000, 0x7f800000, 0xff800000, 0x7f7fffff, 0xff7fffff, 0x00000001,
                                   0x00800000, 0x80000000, 0x7fffffff, 0xffffffff, 0xfffffffd, 0xbf800000, 0x5a000000, 0x3f800000, 0x65432100};
constexpr std::uint64_t long_words[] = {0,
                                        1,
                                        3,
                                        0xffffffffu,
                                        std::uint64_t(1) << 32,
                                        std::uint64_t(1) << 40,
                                        std::uint64_t(1) << 59,
                                        std::uint64_t(1) << 62,
                                        std::uint64_t(1) << 63,
                                        ~std::uint64_t(0),
                                        ~std::uint64_t(0) - 2,
                                        0x7ff0000000000000u,
                                        0x7ff8000000000000u,
                                        0x7fefffffffffffffu,
                                        0x0010000000000000u};

class Damage
{
public:
    explicit Damage(unsigned seed) : random_(seed) {}

    void apply(std::vector<Section>& sections)
    {
        for (std::size_t times = 1 + below(2); times > 0; times--) {
            Section& section = sections[below(sections.size() - 1)]; // all but "end"
            if (section.data.starts_with("{")) change_text(section.data);
            else change_numbers(section.data);
        }
    }

private:
    std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
    template <class T, std::size_t n> T any(const T (&values)[n]) { return below(4) == 0 ? static_cast<T>(random_()) : values[below(n)]; }

    template <class T> void put(std::string& data, std::size_t index, T value)
    {
        if ((index + 1) * sizeof value <= data.size()) std::memcpy(data.data() + index * sizeof value, &value, sizeof value);
    }

    void change_numbers(std::string& data)
    {
        const std::size_t count = data.size() / 4;
        switch (count == 0 ? 5 : below(6)) {
        case 0: // everywhere
            for (std::size_t i = 0, word = any(words); i < count; i++) put(data, i, static_cast<std::uint32_t>(word));
            break;
        case 1:
        case 2: // long numbers: most sections of 8 bytes are counters
            if (count > 1) put(data, below(count / 2), any(long_words));
            break;
        case 3: // one member of every element, for elements of any size
            for (std::size_t stride = 1 + below(16), i = below(stride), word = any(words); i < count; i += stride)
                put(data, i, static_cast<std::uint32_t>(word));
            break;
        case 4:
            put(data, below(count), any(words));
            break;
        default:
            data.resize(below(2) == 0 ? data.size() - std::min<std::size_t>(data.size(), below(64)) : data.size() + below(64));
        }
    }

    // Another value in place of a number or a text.
    void change_text(std::string& data)
    {
        static const char* const values[] = {"-3", "-0.5", "1e400", "18446744073709551613", "9223372036854775808", "null", "\"x\"", "[]", "{}", "0", "1", "[[[[", "\"\\ud800\""};
        std::vector<std::size_t> starts;
        for (std::size_t i = 1; i < data.size(); i++)
            if (data[i - 1] == ':' || data[i - 1] == ',' || data[i - 1] == '[') starts.push_back(i);
        const std::size_t start = starts[below(starts.size())], end = std::min(data.find_first_of(",}]", start), data.size());
        data.replace(start, end - start, values[below(std::size(values))]);
    }

    std::mt19937_64 random_;
};

Scene small_box()
{
    Scene scene = cornell_box(7);
    const uint glass = add_bsdf(scene, DielectricBsdf{1.5f, 1.0f, false, {1, 1, 1}, {1, 1, 1}});
    scene.shapes.push_back(make_sphere({.4f, -.6f, .3f}, .4f, glass));
    return scene;
}

struct Kind {
    std::string name, method;
    std::map<std::string, std::string> parameters;
    bool errors = false;
};

class DamagedState
{
public:
    DamagedState()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "sundog-damaged-XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
        file_ = folder_ / "state";
    }
    ~DamagedState() { std::filesystem::remove_all(folder_); }

    // Damages a checkpoint of the kind so often; returns how many were refused.
    int resume_damaged(const Kind& kind, int times)
    {
        RenderSettings settings = settings_of(kind);
        const RenderSession first(small_box(), shared_device(), settings); // keeps programs for the others
        RenderSession saved(small_box(), shared_device(), settings);
        for (int i = 0; i < 2; i++) saved.iterate();
        saved.save_checkpoint(file_);
        return for_all_damages(times, [&] {
            RenderSession session(small_box(), shared_device(), settings);
            session.resume(file_);
            go_on(session);
        });
    }

    int load_damaged_maps(int times)
    {
        const RenderSettings save = settings_of({"maps", "photonmapper", {{"photons", "300"}, {"save_map", file_.string()}}});
        const RenderSettings load = settings_of({"maps", "photonmapper", {{"load_map", file_.string()}}});
        const RenderSession first(small_box(), shared_device(), save);
        return for_all_damages(times, [&] {
            RenderSession session(small_box(), shared_device(), load);
            go_on(session);
        });
    }

private:
    static RenderSettings settings_of(const Kind& kind)
    {
        RenderSettings settings;
        settings.method = kind.method;
        settings.parameters = kind.parameters;
        settings.seed = 3;
        if (kind.errors) settings.errors = ErrorSettings{};
        return settings;
    }

    static void go_on(RenderSession& session)
    {
        for (int i = 0; i < 2; i++) session.iterate();
        const Image image = session.image();
        EXPECT_TRUE(std::all_of(image.pixels.begin(), image.pixels.end(), [](float value) { return std::isfinite(value); }));
        session.statistics();
    }

    std::string read() const
    {
        std::ifstream file(file_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    template <class Use> int for_all_damages(int times, const Use& use)
    {
        const std::string whole = read();
        int refused = 0;
        for (int i = 0; i < times; i++) {
            SCOPED_TRACE("damage " + std::to_string(i));
            std::vector<Section> sections = sections_of(whole);
            Damage(static_cast<unsigned>(i)).apply(sections);
            std::ofstream(file_, std::ios::binary) << with_right_checksums(whole.substr(0, file_header_bytes), sections);
            try {
                use();
            } catch (const FileError& error) {
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
                refused++;
            } catch (const std::exception& error) {
                ADD_FAILURE() << "not refused as a file: " << error.what();
            }
        }
        return refused;
    }

    std::filesystem::path folder_, file_;
};

std::vector<Kind> kinds()
{
    std::vector<Kind> list;
    for (const MethodInfo* method : all_methods()) list.push_back({method->name, method->name, {}});
    list.push_back({"pssmlt_bdpt", "pssmlt", {{"paths", "bdpt"}, {"seeds", "500"}}});
    for (Kind& kind : list)
        if (kind.method == "pssmlt") kind.parameters["seeds"] = "500";
    list.push_back({"sppm_errors", "sppm", {}, true});
    list.push_back({"path_errors", "path", {}, true});
    for (const char* policy : {"local", "adaptive", "chi_squared", "fixed"})
        list.push_back({std::string("pppm_") + policy, "pppm", {{"radius_policy", policy}}});
    list.push_back({"relaxed_maps", "photonmapper", {{"relaxation_progressive", "true"}, {"photons", "200"}}});
    list.push_back({"fresh_maps", "photonmapper", {{"maps", "fresh"}, {"photons", "200"}}});
    return list;
}

class DamagedCheckpoint : public testing::TestWithParam<Kind>
{
};

class LongDamagedCheckpoint : public testing::TestWithParam<Kind>
{
};

constexpr int few = 40, many = 1000;

TEST_P(DamagedCheckpoint, IsRefusedOrRendersOn)
{
    DamagedState state;
    EXPECT_GT(state.resume_damaged(GetParam(), few), few / 4);
}

TEST_P(LongDamagedCheckpoint, IsRefusedOrRendersOn)
{
    DamagedState state;
    EXPECT_GT(state.resume_damaged(GetParam(), many), many / 4);
}

TEST(DamagedPhotonMaps, AreRefusedOrRendered)
{
    DamagedState state;
    EXPECT_GT(state.load_damaged_maps(few), few / 4);
}

TEST(LongDamagedPhotonMaps, AreRefusedOrRendered)
{
    DamagedState state;
    EXPECT_GT(state.load_damaged_maps(many), many / 4);
}

const auto name_of = [](const auto& kind) { return kind.param.name; };
INSTANTIATE_TEST_SUITE_P(Kinds, DamagedCheckpoint, testing::ValuesIn(kinds()), name_of);
INSTANTIATE_TEST_SUITE_P(Kinds, LongDamagedCheckpoint, testing::ValuesIn(kinds()), name_of);

} // namespace
