#include <gnomon/check/check.hpp>

#include <gnomon/trace/build.hpp>
#include <gnomon/trace/query.hpp>

#include "embree_scene.hpp"
#include "scenes.hpp"
#include "yard_view.hpp"

#include <cstdio>
#include <vector>

using namespace gnomon;
using scenes::Light;
using scenes::Segment;
using scenes::TriangleId;

#if defined(GNOMON_HAS_EMBREE)

namespace {

struct Comparison {
    int samples = 0;
    int shadowed = 0;
    int differing = 0;
    int undecided = 0;  ///< Differing samples on which integers of any length do not give our answer.
};

/// Asks both about each sample; where they differ, brute force in exact integers says who is right.
Comparison compare(scenes::Mesh const& mesh, std::vector<sample::ViewSample> const& samples, trace::Bvh const& bvh,
                   Light const& light) {
    peer::EmbreeScene const embree(mesh.list(), "threads=1");
    Comparison result;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples[i].triangle.is_none()) continue;
        Segment const s{samples[i].position, light};
        bool const ours = is_blocked(bvh, s, samples[i].triangle);
        bool const theirs = embree.is_blocked(s, samples[i].triangle);
        ++result.samples;
        result.shadowed += ours ? 1 : 0;
        if (ours == theirs) continue;
        ++result.differing;
        bool const truth = scenes::blocked_by_any(mesh, s, samples[i].triangle);
        result.undecided += truth == ours ? 0 : 1;
        if (result.differing <= 20)
            std::printf("differs: sample %zu at (%.9g, %.9g, %.9g) of triangle %u: exact %s, Embree %s\n", i,
                        static_cast<double>(s.start.x), static_cast<double>(s.start.y), static_cast<double>(s.start.z),
                        samples[i].triangle.value, truth ? "blocked" : "free", theirs ? "blocked" : "free");
    }
    std::printf("Embree: %d of %d samples differ, %d in shadow\n", result.differing, result.samples, result.shadowed);
    return result;
}

void compare_yard(int subdivision, int size_px) {
    scenes::Yard const yard(subdivision);
    trace::Bvh const bvh = trace::build_bvh(yard.mesh.list());
    auto const samples = scenes::yard_samples(yard.mesh, bvh, size_px);
    for (Light const& light : {Light::point(math::vec3(12.3F, 220.7F, -120.1F)), Light::direction(math::vec3(0.45F, 0.8F, 0.4F))}) {
        Comparison const c = compare(yard.mesh, samples, bvh, light);
        CHECK(c.undecided == 0);
        CHECK(c.differing <= c.samples / 10'000);
        CHECK(c.shadowed > c.samples / 10);
    }
}

}  // namespace

TEST_CASE("Embree agrees on the yard's samples, but for ties that exact arithmetic decides", "[trace][embree]") {
    compare_yard(2, 384);
}

TEST_CASE("Embree agrees on the yards of 59k and 274k triangles at 1024 x 1024", "[.full][trace][embree]") {
    compare_yard(2, 1024);
    compare_yard(5, 1024);
}

#else

TEST_CASE("Embree agrees on the yard's samples, but for ties that exact arithmetic decides", "[trace][embree]") {
    SKIP("Embree is not installed");
}

#endif
