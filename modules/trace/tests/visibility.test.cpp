#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <gnomon/trace/build.hpp>
#include <gnomon/trace/visibility.hpp>

#include "scenes.hpp"

#include <limits>
#include <vector>

using namespace gnomon;
using scenes::Light;
using scenes::TriangleId;

namespace {

struct Sample {
    TriangleId triangle;
    math::vec3 position;
};

std::vector<Sample> samples_of(scenes::Mesh const& mesh, std::size_t count, std::uint64_t seed) {
    scenes::Random random{seed};
    std::vector<Sample> samples(count);
    for (Sample& s : samples) {
        if (random.below(10) == 0) continue;  // background
        s.triangle = TriangleId(static_cast<std::uint32_t>(random.below(static_cast<int>(mesh.corners.size()))));
        auto const t = mesh.list()[s.triangle];
        s.position = t[0] * 0.5F + t[1] * 0.25F + t[2] * 0.25F;
    }
    return samples;
}

}  // namespace

TEST_CASE("visibility sets the bit of every blocked sample, and sums are the same for any number of threads", "[trace]") {
    scenes::Yard const yard(2, 8);
    trace::Bvh const bvh = trace::build_bvh(yard.mesh.list());
    auto const samples = samples_of(yard.mesh, 10'007, 51);
    auto const light = Light::point(math::vec3(12.3F, 220.7F, -120.1F));
    std::vector<std::uint64_t> expected(trace::visibility_words(samples.size()), ~std::uint64_t{0});
    core::SerialExecutor const serial;
    auto const stats = visibility(bvh, std::span<Sample const>(samples), expected, serial, trace::VisibilityConfig<>{light});
    std::size_t count = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        bool const truth = !samples[i].triangle.is_none() &&
                           is_blocked(bvh, {samples[i].position, light}, samples[i].triangle);
        REQUIRE(trace::is_in_shadow(expected, i) == truth);
        count += truth ? 1U : 0U;
    }
    CHECK(expected.back() >> (samples.size() % 64) == 0);
    CHECK(stats.in_shadow == count);
    CHECK(stats.in_shadow > 1'000);
    CHECK(stats.invalid == 0);
    for (int const threads : {1, 2, 7}) {
        core::ThreadExecutor const executor(threads);
        std::vector<std::uint64_t> bits(expected.size());
        CHECK(visibility(bvh, std::span<Sample const>(samples), bits, executor, trace::VisibilityConfig<>{light}) == stats);
        CHECK(bits == expected);
    }
}

TEST_CASE("a sample whose own plane separates eye and light is in shadow, if the eye is given", "[trace]") {
    scenes::Mesh mesh;
    mesh.add(math::vec3(0.0F, 1.0F, 0.0F), math::vec3(0.0F, 1.0F, 4.0F), math::vec3(4.0F, 1.0F, 0.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    std::vector<Sample> const samples{{TriangleId(0), math::vec3(1.0F)}};
    std::vector<std::uint64_t> bits(1);
    core::SerialExecutor const serial;
    trace::VisibilityConfig<> config;
    auto const shadow = [&](Light const& light) {
        config.light = light;
        visibility(bvh, std::span<Sample const>(samples), bits, serial, config);
        return trace::is_in_shadow(bits, 0);
    };
    auto const below = Light::point(math::vec3(1.0F, -9.0F, 1.0F));
    auto const in_plane = Light::direction(math::vec3(1.0F, 0.0F, 0.0F));
    CHECK_FALSE(shadow(below));
    config.own_plane = trace::OwnPlane{mesh.list(), predicates::Target::point(math::vec3(0.0F, 5.0F, 0.0F))};
    CHECK(shadow(below));
    CHECK_FALSE(shadow(in_plane));
    config.own_plane->eye = predicates::Target::direction(math::vec3(0.0F, -1.0F, 0.0F));
    CHECK_FALSE(shadow(below));
}

TEST_CASE("NaN samples and lights are lit and counted", "[trace][degenerate]") {
    scenes::Mesh mesh;
    mesh.add(math::vec3(-9.0F, 2.0F, -9.0F), math::vec3(0.0F, 2.0F, 9.0F), math::vec3(9.0F, 2.0F, -9.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    float const nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Sample> const samples{{TriangleId(7), math::vec3(0.0F)}, {TriangleId(8), math::vec3(nan, 0.0F, 0.0F)}, {}};
    std::vector<std::uint64_t> bits(1);
    core::SerialExecutor const serial;
    auto const run = [&](Light const& light) { return visibility(bvh, std::span<Sample const>(samples), bits, serial, trace::VisibilityConfig<>{light}); };
    auto const good = run(Light::direction(math::vec3(0.0F, 1.0F, 0.0F)));
    CHECK(bits[0] == 1);
    CHECK(good.samples == 2);
    CHECK(good.in_shadow == 1);
    CHECK(good.invalid == 1);
    for (Light const& bad : {Light::direction(math::vec3(0.0F)), Light::point(math::vec3(0.0F, nan, 0.0F)),
                             Light::point(math::vec3(0.0F, std::numeric_limits<float>::infinity(), 0.0F))}) {
        CHECK(run(bad).invalid == 2);
        CHECK(bits[0] == 0);
    }
}
