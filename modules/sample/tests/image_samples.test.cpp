#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <gnomon/sample/image_samples.hpp>


#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using sample::ViewSample;

namespace {

/// One large ground quad below the eye, one broken triangle, and one with a bad index.
struct Ground {
    std::vector<math::vec3> positions{math::vec3(-900.0F, 0.0F, -900.0F), math::vec3(-900.0F, 0.0F, 900.0F),
                                      math::vec3(900.0F, 0.0F, 900.0F), math::vec3(900.0F, 0.0F, -900.0F),
                                      math::vec3(std::numeric_limits<float>::quiet_NaN())};
    std::vector<math::uvec3> corners{math::uvec3(0, 1, 2), math::uvec3(0, 2, 3), math::uvec3(0, 1, 4), math::uvec3(0, 1, 99)};

    [[nodiscard]] sample::SampleFrame frame(math::View const& view, math::dvec3 const& origin_m) const {
        return {view, origin_m, {positions, corners}};
    }
};

}  // namespace

TEST_CASE("the samples of an image project to their pixel centres, wherever work space has its zero", "[sample]") {
    Ground const ground;
    for (double const far_away : {0.0, 1e7}) {
        math::dvec3 const origin_m(1024.0 * std::round(far_away / 1024.0), 0.0, 0.0);
        for (bool const orthographic : {false, true}) {
            math::dvec3 const eye = origin_m + math::dvec3(3.0, 40.0, 7.0);
            math::dvec3 const target = origin_m + math::dvec3(5.0, 0.0, -30.0);
            math::View view;
            if (orthographic)
                view = math::make_orthographic({.eye_m = eye, .target_m = target, .window_m = {-20.0, 20.0, -9.0, 9.0}, .near_m = -50.0, .far_m = 200.0, .size_px = math::ivec2(64, 48)}).value();
            else
                view = math::make_perspective({.eye_m = eye, .target_m = target, .size_px = math::ivec2(64, 48)}).value();
            auto const frame = ground.frame(view, origin_m);
            std::vector<std::uint32_t> const ids(64 * 48, 0U);
            std::vector<ViewSample> samples(ids.size());
            core::SerialExecutor const serial;
            auto const stats = make_view_samples(frame, ids, samples, serial);
            CHECK(stats.samples == samples.size());
            CHECK(stats.edge_on == 0);
            double worst_px = 0.0;
            for (std::size_t i = 0; i < samples.size(); ++i) {
                math::vec3 const& p = samples[i].position;
                REQUIRE(p.y == 0.0F);
                math::dvec3 const at = math::project(view, math::to_double(p) - (view.eye_m - origin_m));
                bool const on_triangle = p.x <= p.z;  // triangle 0 is the half where x <= z
                if (!on_triangle || std::abs(p.x) >= 900.0F || std::abs(p.z) >= 900.0F || p.x == p.z) continue;
                worst_px = std::fmax(worst_px, std::abs(at.x - (static_cast<double>(i % 64) + 0.5)));
                worst_px = std::fmax(worst_px, std::abs(at.y - (static_cast<double>(i / 64) + 0.5)));
            }
            CHECK(worst_px < 1e-3);
        }
    }
}

TEST_CASE("pixels without a usable triangle give no sample and are counted", "[sample][degenerate]") {
    Ground const ground;
    auto const view = math::make_perspective({.eye_m = math::dvec3(0.0, 5.0, 0.0), .target_m = math::dvec3(1.0, 0.0, 0.0), .size_px = math::ivec2(5, 1)}).value();
    std::array const ids{0U, 1U, 2U, 3U, ~0U};
    std::array<ViewSample, 5> samples;
    core::SerialExecutor const serial;
    CHECK(make_view_samples(ground.frame(view, math::dvec3(0.0)), ids, samples, serial) == sample::SampleStats{2, 1, 2, 0});
    CHECK(samples[1].triangle == core::TriangleId(1));
    CHECK(samples[2].triangle.is_none());
    std::array const unknown{77U, ~0U - 1U, 0U, 0U, 0U};
    CHECK(make_view_samples(ground.frame(view, math::dvec3(0.0)), unknown, samples, serial).unusable == 2);
}

TEST_CASE("an image's samples are the same for any number of threads", "[sample][determinism]") {
    Ground const ground;
    auto const view = math::make_perspective({.eye_m = math::dvec3(0.0, 1.7, 0.0), .target_m = math::dvec3(9.0, 1.0, 3.0), .size_px = math::ivec2(200, 150)}).value();
    std::vector<std::uint32_t> ids(200 * 150);
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::uint32_t>(i % 3);
    std::vector<ViewSample> expected(ids.size());
    core::SerialExecutor const serial;
    auto const stats = make_view_samples(ground.frame(view, math::dvec3(0.0)), ids, expected, serial);
    for (int const threads : {1, 2, 7}) {
        core::ThreadExecutor const executor(threads);
        std::vector<ViewSample> samples(ids.size());
        CHECK(make_view_samples(ground.frame(view, math::dvec3(0.0)), ids, samples, executor) == stats);
        CHECK(samples == expected);
    }
}
