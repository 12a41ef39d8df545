#include <gnomon/batch/validate.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/scene/batches.hpp>
#include <gnomon/scene/procedural.hpp>

#include <set>

using namespace gnomon;

namespace {

batch::Triangles batched_triangles(scene::GeometryBatches const& b, scene::Geometry const& g) {
    return {g.positions, g.indices, b.group_of_triangle};
}

}  // namespace

TEST_CASE("batches of a geometry are of one instance and one draw, and hold each triangle once", "[scene][batches]") {
    for (char const* const name : {"city", "cubes", "forest"}) {
        auto const made = scene::make_procedural({.name = name});
        REQUIRE(made.has_value());
        scene::Geometry const g = scene::flatten(*made);
        scene::GeometryBatches const b = scene::make_batches(g);
        CAPTURE(name);
        CHECK(validate(b.batches, batched_triangles(b, g), 128) == batch::BatchFault::none);
        CHECK(b.batches.triangles.size() == g.indices.size() / 3);
        CHECK(b.indices.size() == g.indices.size());
        std::size_t wrong = 0;
        std::set<std::pair<std::uint32_t, std::uint32_t>> groups;
        for (batch::Batch const& one : b.batches.batches)
            for (std::size_t i = one.first; i < one.first + one.count; ++i) {
                std::uint32_t const t = b.batches.triangles[i];
                scene::BatchGroup const& group = b.groups[one.group];
                scene::DrawRange const& draw = g.draws[group.draw];
                groups.insert({group.instance, group.draw});
                wrong += g.triangle_instance[t] == group.instance ? 0U : 1U;
                wrong += t >= draw.first_triangle && t < draw.first_triangle + draw.triangle_count ? 0U : 1U;
                for (std::size_t k = 0; k < 3; ++k) wrong += b.indices[3 * i + k] == g.indices[3 * t + k] ? 0U : 1U;
            }
        CHECK(wrong == 0);
        CHECK(groups.size() == b.groups.size());
    }
}

TEST_CASE("boxes of a geometry's batches follow its positions, for any threads", "[scene][batches]") {
    auto const made = scene::make_procedural({.name = "cubes"});
    REQUIRE(made.has_value());
    scene::Geometry g = scene::flatten(*made);
    scene::GeometryBatches b = scene::make_batches(g, {.max_triangles = 32});
    core::ThreadExecutor threads(2);
    scene::GeometryBatches other = scene::make_batches(g, {.max_triangles = 32}, threads);
    CHECK(b.batches.batches == other.batches.batches);
    for (math::vec3& p : g.positions) p = p * 1.25F + math::vec3(1.0F, 2.0F, 3.0F);
    CHECK(validate(b.batches, batched_triangles(b, g), 32) == batch::BatchFault::loose_box);
    CHECK(refit(b, g) == 0);
    CHECK(validate(b.batches, batched_triangles(b, g), 32) == batch::BatchFault::none);
    CHECK(refit(other, g, threads) == 0);
    CHECK(b.batches.boxes == other.batches.boxes);
}

TEST_CASE("a geometry without triangles has no batches", "[scene][batches][degenerate]") {
    scene::Geometry const nothing;
    scene::GeometryBatches const b = scene::make_batches(nothing);
    CHECK(b.batches.batches.empty());
    CHECK(b.groups.empty());
}
