#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace gnomon;

std::vector<std::int64_t> brute_force(std::vector<std::uint8_t> const& mask, math::ivec2 const& size) {
    std::vector<std::int64_t> distance(mask.size(), pipeline::no_distance);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int v = 0; v < size.y; ++v)
                for (int u = 0; u < size.x; ++u) {
                    if (mask[static_cast<std::size_t>(v * size.x + u)] == 0) continue;
                    std::int64_t const d = std::int64_t{x - u} * (x - u) + std::int64_t{y - v} * (y - v);
                    std::int64_t& least = distance[static_cast<std::size_t>(y * size.x + x)];
                    least = d < least ? d : least;
                }
    return distance;
}

/// A frame that is only its truth: one row of samples per string, 'L' lit, 's' in shadow, '.' background.
pipeline::Frame frame_of(std::vector<std::string> const& rows) {
    pipeline::Frame frame;
    frame.view.size_px = math::ivec2(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
    std::uint32_t pixel = 0;
    for (std::string const& row : rows)
        for (char const c : row) {
            if (c != '.') {
                frame.samples.pixel.push_back(pixel);
                frame.lit.push_back(c == 'L' ? 1 : 0);
            }
            ++pixel;
        }
    return frame;
}

}  // namespace

TEST_CASE("the distance transform equals brute force on any mask", "[pipeline][measures][property]") {
    auto const sizes = check::integers(1, 12);
    check::for_all(check::cases(600), sizes, sizes, check::integers<std::uint64_t>(), check::integers(1, 9),
                   [](int width, int height, std::uint64_t seed, int rarity) {
                       math::ivec2 const size(width, height);
                       std::vector<std::uint8_t> mask(pipeline::pixel_count(size));
                       for (auto& m : mask) {
                           seed = seed * 6364136223846793005U + 1442695040888963407U;
                           m = static_cast<int>((seed >> 40U) % 10U) >= rarity ? 1 : 0;
                       }
                       CHECK(pipeline::squared_distance(mask, size) == brute_force(mask, size));
                   });
}

TEST_CASE("an empty mask is infinitely far, a full one nowhere", "[pipeline][measures]") {
    math::ivec2 const size(5, 3);
    for (std::int64_t const d : pipeline::squared_distance(std::vector<std::uint8_t>(15, 0), size))
        CHECK(d == pipeline::no_distance);
    for (std::int64_t const d : pipeline::squared_distance(std::vector<std::uint8_t>(15, 1), size)) CHECK(d == 0);
    std::vector<std::uint8_t> corner(15, 0);
    corner[0] = 1;
    CHECK(pipeline::squared_distance(corner, size)[14] == 4 * 4 + 2 * 2);
}

TEST_CASE("percentiles are nearest ranks", "[pipeline][measures]") {
    std::vector<double> values{5.0, 1.0, 4.0, 2.0, 3.0};
    CHECK(pipeline::percentile(values, 0.0) == 1.0);
    CHECK(pipeline::percentile(values, 0.2) == 1.0);
    CHECK(pipeline::percentile(values, 0.5) == 3.0);
    CHECK(pipeline::percentile(values, 0.99) == 5.0);
    CHECK(pipeline::percentile(values, 1.0) == 5.0);
    CHECK(pipeline::percentile({}, 0.5) == 0.0);
}

TEST_CASE("edge errors are distances to the nearest sample of the claimed state", "[pipeline][measures]") {
    pipeline::Frame const frame = frame_of({"LLLss", "LL..s"});
    //                                        0..4    5,6  7
    std::vector<float> visibility{1.0F, 1.0F, 1.0F, 0.0F, 1.0F, 1.0F, 1.0F, 0.0F};
    pipeline::EdgeError const edge = pipeline::measure_edges(frame, visibility);
    CHECK(edge.mean == 2.0);  // pixel (4, 0) says lit; the nearest truly lit sample is (2, 0)
    CHECK(edge.max == 2.0);
    visibility[0] = 0.0F;  // (0, 0) says shadow; the nearest is (3, 0)
    CHECK(pipeline::measure_edges(frame, visibility).mean == 2.5);
    CHECK(pipeline::measure_edges(frame, visibility).max == 3.0);
}

TEST_CASE("a state that does not exist in the truth is infinitely far", "[pipeline][measures]") {
    pipeline::Frame const frame = frame_of({"LLL"});
    std::vector<float> const visibility{1.0F, 0.0F, 1.0F};
    pipeline::EdgeError const edge = pipeline::measure_edges(frame, visibility);
    CHECK(std::isinf(edge.mean));
    CHECK(std::isinf(edge.max));
    CHECK(pipeline::measure_edges(frame, std::vector<float>{1.0F, 1.0F, 1.0F}).max == 0.0);
}

TEST_CASE("wrong samples split into false-lit and false-shadow at one half", "[pipeline][measures]") {
    pipeline::Frame const frame = frame_of({"LLss"});
    pipeline::TechniqueOutput output;
    output.visibility = {0.5F, 0.4999F, 0.5F, 0.25F};
    output.own_hit = {1, 1, 1, 1};
    core::SerialExecutor const serial;
    pipeline::Measures const m = pipeline::measure(frame, output, serial);
    CHECK(m.samples == 4);
    CHECK(m.wrong == 2);
    CHECK(m.false_lit == 1);
    CHECK(m.false_shadow == 1);
    CHECK(m.acne == 1);  // only where the shadow is false
    CHECK(m.wrong_fraction == 0.5);
    CHECK(m.visibility_error_mean == Approx((0.5 + 0.5001 + 0.5 + 0.25) / 4.0).margin(1e-6));
    CHECK(m.visibility_error_p99 == Approx(0.5001).margin(1e-6));
}

TEST_CASE("a frame without samples has no errors", "[pipeline][measures]") {
    pipeline::Frame const frame = frame_of({"...", "..."});
    core::SerialExecutor const serial;
    pipeline::Measures const m = pipeline::measure(frame, {}, serial);
    CHECK(m.samples == 0);
    CHECK(m.wrong_fraction == 0.0);
    CHECK(m.edge_px.max == 0.0);
}
