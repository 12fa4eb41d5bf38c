// begin_final_gather and shade_gather_path against plain C++, along gather rays from what the camera sees.
#include "kernels/shading_fixture.h"

namespace sundog
{
namespace
{

class FinalGatherStages : public ShadingStage
{
protected:
    static constexpr float radius = 0.0625f;

    // As if the camera's paths had asked for photons where it looks first; every fifth did not, every seventh at a narrow lobe.
    std::vector<GatherQuery> questions(const std::vector<Hit>& hits) const
    {
        std::vector<GatherQuery> queries(hits.size(), GatherQuery{});
        for (std::size_t path = 0; path < hits.size(); ++path) {
            if (hits[path].primitive != NO_PRIMITIVE && path % 5 != 0) queries[path].radius = 1.0f;
            if (path % 7 == 0) queries[path].flags = QUERY_UNREACHED_ONLY;
        }
        return queries;
    }

    PlainOutcome first_step(const PlainVertex& vertex, const GatherQuery& question, uint path, Doubt& doubt) const
    {
        PlainOutcome outcome;
        if (question.radius == 0.0f) return outcome;
        outcome.surface = plain_surface(plain_.flat, vertex.ray, vertex.hit, doubt);
        outcome.side = plain_side(plain_, *outcome.surface);
        if (question.flags == 0 && allows(rules(), vertex.path.depth + 2))
            outcome.next = plain_camera_step(vertex.path, *outcome.surface, *outcome.side, rules(),
                                             camera_numbers(path).scatter(vertex.path.depth, 1), doubt);
        return outcome;
    }

    Kernel begin_{device_, "begin_final_gather", "Begin", options_};
    Kernel shade_{device_, "shade_gather_path", "Shade", options_};
};

TEST_P(FinalGatherStages, DoAsPlainCode)
{
    start_camera_paths();
    activate_all(pixels_.size());
    const uint count = static_cast<uint>(pixels_.size());
    const auto queries = allocate<GatherQuery>(count);
    const auto lobes = allocate<LobeRecord>(1);
    std::vector<GatherQuery> asked, got;
    bool begun = false;
    follow_paths(
        [&](std::size_t items) {
            if (!begun) {
                asked = questions(hits_.download());
                begin_(count, scene_.surfaces(), key_, rules(), count, upload(asked), hits_, rays_, paths_, active_, flags_);
                device_.finish();
                const auto all = active_.download();
                for (uint path = 0; path < count; ++path) ASSERT_EQ(all[path], path);
                return;
            }
            Buffer<GatherQuery> cleared = upload(std::vector<GatherQuery>(count, GatherQuery{}));
            shade_(items, scene_.surfaces(), key_, rules(), radius, hits_, active_, active_count_, rays_, paths_, cleared, lobes, flags_);
            got = cleared.download();
        },
        [&](std::size_t item, uint path, const PlainVertex& vertex) {
            begun = true;
            Doubt doubt;
            const bool is_first = got.empty();
            const PlainOutcome expected = is_first ? first_step(vertex, asked[path], path, doubt)
                                                   : plain_gather_vertex(plain_, vertex, rules(), camera_numbers(path), doubt);
            if (!is_certain(vertex, expected, doubt)) return;
            expect_step(item, path, expected.next);
            if (!is_first) expect_query(path, vertex, expected, got[path], radius);
            expect_radiance(path, {});
        });
    expect_few_in_doubt();
    expect_all_surfaces_seen();
    if (GetParam().complete) expect_seen({"records"});
}

INSTANTIATE_TEST_SUITE_P(Rules, FinalGatherStages, testing::ValuesIn(shading_cases()), case_name);

} // namespace
} // namespace sundog
