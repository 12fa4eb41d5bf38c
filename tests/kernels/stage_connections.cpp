// The lists of connections, against plain loops; and that resampling chooses evenly.
#include "shared/bidirectional.h"
#include "shared/queue.h"
#include "stages/sampling.h"
#include "support/chi_squared.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <random>

namespace sundog
{
namespace
{

constexpr uint light_paths = 700;
constexpr uint camera_paths = 1000; // more than a chunk of items, and more than light paths

class ConnectionStage : public DeviceFixture
{
protected:
    ConnectionStage()
    {
        // Light subpaths of up to four vertices, bounce by bounce in path order, some slots without a vertex.
        last_.assign(light_paths, NO_VERTEX);
        for (int bounce = 0; bounce < 4; bounce++)
            for (uint path = 0; path < light_paths; path++) {
                if (random_() % 3 == 0) continue; // no slot: the path has ended or is elsewhere
                VertexLink link{NO_VERTEX, 0};
                if (random_() % 4 > 0) {
                    link = {last_[path], last_[path] == NO_VERTEX ? 1 : links_[last_[path]].rank + 1};
                    last_[path] = static_cast<uint>(links_.size());
                }
                links_.push_back(link);
            }
        for (uint path = 0; path < camera_paths; path++)
            if (random_() % 5 > 0) active_.push_back(path);
        for (std::size_t item = 0; item < active_.size(); item++)
            flags_.push_back((random_() % 2 > 0 ? PATH_ALIVE : PATH_ENDED) | (random_() % 3 > 0 ? PATH_JOINS : PATH_ENDED));
    }

    uint chunks() const { return (static_cast<uint>(active_.size()) + FLAG_CHUNK - 1) / FLAG_CHUNK; }
    uint joins() const
    {
        return static_cast<uint>(std::count_if(flags_.begin(), flags_.end(), [](uint flag) { return (flag & PATH_JOINS) != 0; }));
    }

    std::mt19937 random_{3};
    const SamplerKey key_ = sampler_key(5, 2);
    std::vector<uint> last_, active_, flags_;
    std::vector<VertexLink> links_;
};

struct ListedPairs {
    std::vector<uint> firsts;
    std::vector<VertexPair> pairs;
};

TEST_F(ConnectionStage, EachCameraVertexMeetsAllVerticesOfOneLightSubpath)
{
    const auto active = upload(active_), count = upload(std::vector<uint>{static_cast<uint>(active_.size())}), flags = upload(flags_),
               last = upload(last_);
    const auto links = upload(links_);
    const auto counts = allocate<uint>(chunks()), total = allocate<uint>(1);
    Kernel(device_, "count_connections", "Count")(chunks(), key_, light_paths, active, count, flags, last, links, chunks(), counts);
    Kernel(device_, "scan_counts", "Scan").launch_grouped(1, 1, counts, chunks(), 0u, total);
    const uint listed = total.read(0);
    const Kernel list(device_, "list_connections", "List");
    // In windows that end anywhere, the same as at once.
    ListedPairs got;
    constexpr uint capacity = 257;
    for (uint window = 0; window < listed; window += capacity) {
        const auto firsts = allocate<uint>(active_.size() + 1);
        const auto pairs = allocate<VertexPair>(capacity);
        list(chunks(), key_, light_paths, active, count, flags, last, links, chunks(), counts, window, capacity, firsts, pairs);
        got.firsts = firsts.download();
        const auto some = pairs.download(0, std::min(capacity, listed - window));
        got.pairs.insert(got.pairs.end(), some.begin(), some.end());
    }
    uint place = 0;
    int shift = -1; // of light subpaths against camera subpaths: the same for all
    for (std::size_t item = 0; item < active_.size(); item++) {
        ASSERT_EQ(got.firsts[item], place) << item;
        if (!(flags_[item] & PATH_JOINS)) continue;
        ASSERT_LE(got.firsts[item + 1], listed);
        if (got.firsts[item + 1] == place) continue; // a light subpath without vertices
        const auto owner = std::find(last_.begin(), last_.end(), got.pairs[place].slot);
        ASSERT_NE(owner, last_.end()) << item;
        const uint path = static_cast<uint>(owner - last_.begin());
        const int this_shift = static_cast<int>((path + 2 * light_paths - active_[item] % light_paths) % light_paths);
        if (shift < 0) shift = this_shift;
        EXPECT_EQ(this_shift, shift) << item;
        for (uint slot = last_[path]; slot != NO_VERTEX; slot = links_[slot].previous, place++) {
            EXPECT_EQ(got.pairs[place].path, active_[item]);
            EXPECT_EQ(got.pairs[place].slot, slot);
        }
    }
    EXPECT_EQ(place, listed);
    EXPECT_EQ(got.firsts.back(), listed);
}

TEST_F(ConnectionStage, PicksAreEvenOverAllSlots)
{
    const auto active = upload(active_), count = upload(std::vector<uint>{static_cast<uint>(active_.size())}), flags = upload(flags_);
    const auto links = upload(links_);
    PathVertex vertex{};
    vertex.depth = 2;
    const auto vertices = upload(std::vector<PathVertex>(camera_paths, vertex));
    BuildOptions options;
    use_sampler(options, SamplerKind::independent);
    const Kernel count_flagged(device_, "count_flagged", "Count"), scan(device_, "scan_counts", "Scan"),
        list(device_, "resample_connections", "List", options);
    constexpr uint picks = 3;
    const uint slots = static_cast<uint>(links_.size());
    std::vector<double> chosen(40, 0.0), expected(40, 0.0);
    std::vector<uint> empty(2, 0);
    for (uint iteration = 0; iteration < 50; iteration++) {
        const auto counts = allocate<uint>(chunks()), total = allocate<uint>(1), firsts = allocate<uint>(active_.size() + 1);
        const auto pairs = allocate<VertexPair>(picks * joins());
        count_flagged(chunks(), flags, count, PATH_JOINS, chunks(), counts);
        scan.launch_grouped(1, 1, counts, chunks(), 0u, total);
        ASSERT_EQ(total.read(0), joins());
        list(chunks(), sampler_key(5, iteration), picks, slots, active, count, flags, vertices, links, chunks(), counts, 0u,
             picks * joins(), firsts, pairs);
        const auto got = pairs.download();
        const auto first = firsts.download();
        uint place = 0;
        for (std::size_t item = 0; item < active_.size(); item++) {
            ASSERT_EQ(first[item], place);
            if (!(flags_[item] & PATH_JOINS)) continue;
            for (uint pick = 0; pick < picks; pick++, place++) {
                ASSERT_EQ(got[place].path, active_[item]);
                if (got[place].slot == NO_VERTEX) continue;
                ASSERT_GT(links_[got[place].slot].rank, 0u);
                chosen[got[place].slot * chosen.size() / slots]++;
            }
        }
        EXPECT_EQ(first.back(), place);
    }
    for (uint slot = 0; slot < slots; slot++)
        if (links_[slot].rank > 0) expected[slot * expected.size() / slots] += 50.0 * picks * joins() / slots;
    // The choices that fell on empty slots are a cell of their own.
    double filled = 0.0, filled_expected = 0.0;
    for (std::size_t i = 0; i < chosen.size(); i++) filled += chosen[i], filled_expected += expected[i];
    chosen.push_back(50.0 * picks * joins() - filled);
    expected.push_back(50.0 * picks * joins() - filled_expected);
    EXPECT_GT(chi_squared(chosen, expected).p, 1e-3);
}

TEST_F(ConnectionStage, FreeConnectionsAddUp)
{
    const std::vector<uint> active = {4, 0, 2}, firsts = {0, 2, 2, 5}, occluded = {0, 1, 1, 0, 0};
    const std::vector<Vec3> connected = {{1, 2, 3}, {9, 9, 9}, {9, 9, 9}, {4, 5, 6}, {10, 20, 30}};
    const auto radiance = upload(std::vector<Vec3>(5, Vec3{0.5f, 0.5f, 0.5f}));
    const Kernel add(device_, "add_connections", "Add");
    const auto count = upload(std::vector<uint>{3});
    // Two windows: places 0 to 3, and 4.
    add(3, upload(active), count, upload(firsts), 0u, 4u, upload(occluded), upload(connected), radiance);
    add(3, upload(active), count, upload(firsts), 4u, 1u, upload(std::vector<uint>{0}), upload(std::vector<Vec3>{connected[4]}), radiance);
    const auto got = radiance.download();
    EXPECT_FLOAT_EQ(got[4].x, 1.5f);
    EXPECT_FLOAT_EQ(got[4].z, 3.5f);
    EXPECT_FLOAT_EQ(got[0].x, 0.5f);
    EXPECT_FLOAT_EQ(got[2].x, 14.5f);
    EXPECT_FLOAT_EQ(got[2].y, 25.5f);
}

} // namespace
} // namespace sundog
