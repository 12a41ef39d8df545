// Posing and updating a frame in the memory of the last one. The counter sits in operator new, for this whole program.
#include "motion_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/pose.hpp>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> made_in_scene_tests{0};

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t bytes) {
    made_in_scene_tests.fetch_add(1, std::memory_order_relaxed);
    if (void* const p = std::malloc(bytes == 0 ? 1 : bytes)) return p;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::nothrow_t const&) noexcept {
    made_in_scene_tests.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(bytes == 0 ? 1 : bytes);
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::nothrow_t const&) noexcept { std::free(p); }

TEST_CASE("after the first frame, posing and updating allocate nothing", "[scene][motion][memory]") {
    using namespace gnomon;
    auto const loaded = fixture::load(fixture::moving_file());
    REQUIRE(loaded.has_value());
    std::uint64_t const before_any = made_in_scene_tests.load();
    scene::Geometry frame = scene::flatten(*loaded);
    CHECK(made_in_scene_tests.load() > before_any);  // the counter counts
    scene::Pose pose;
    scene::pose_at(*loaded, {0.0, scene::all_clips, true}, pose);
    std::uint64_t const before = made_in_scene_tests.load();
    for (int i = 0; i < 60; ++i) {
        scene::pose_at(*loaded, {i / 15.0, i % 2 == 0 ? 0 : scene::all_clips, true}, pose);
        scene::update(frame, *loaded, pose);
    }
    CHECK(made_in_scene_tests.load() == before);
}
