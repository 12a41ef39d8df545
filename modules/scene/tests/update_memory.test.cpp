// Posing and updating a frame in the memory of the last one.
#include "motion_fixture.hpp"

#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/pose.hpp>

GNOMON_COUNT_ALLOCATIONS;

TEST_CASE("after the first frame, posing and updating allocate nothing", "[scene][motion][memory]") {
    using namespace gnomon;
    auto const loaded = fixture::load(fixture::moving_file());
    REQUIRE(loaded.has_value());
    std::uint64_t const before_any = check::allocations_made();
    scene::Geometry frame = scene::flatten(*loaded);
    CHECK(check::allocations_made() > before_any);  // the counter counts
    scene::Pose pose;
    scene::pose_at(*loaded, {0.0, scene::all_clips, true}, pose);
    std::uint64_t const before = check::allocations_made();
    for (int i = 0; i < 60; ++i) {
        scene::pose_at(*loaded, {i / 15.0, i % 2 == 0 ? 0 : scene::all_clips, true}, pose);
        scene::update(frame, *loaded, pose);
    }
    CHECK(check::allocations_made() == before);
}
