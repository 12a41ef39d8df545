#include "parity.hpp"

#include "../../cull/tests/hard_pairs.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/cull/rows.hpp>

#include "shaders/parity_rows_comp.hpp"

#include <array>
#include <cstddef>

namespace {

using namespace gnomon;
using vulkan::test::HardFloats;

constexpr std::size_t rows_in = 16;
constexpr std::size_t rows_out = 32;
using RowsItem = std::array<float, rows_in>;

/// A light that nearly touches a cluster of a hard grid; one in thirty-two of hard numbers.
RowsItem rows_item(test::Draw& draw, HardFloats& random) {
    test::HardGrid const g = test::make_hard_grid(draw);
    std::uint32_t const column = draw.below(static_cast<unsigned>(g.x.size() - 1));
    std::uint32_t const row = draw.below(static_cast<unsigned>(g.y.size() - 1));
    std::uint32_t const slice = draw.below(static_cast<unsigned>(g.depth_m.size() - 1));
    test::HardLight const l = test::make_hard_light(draw, g, {column, row, slice});
    bool const perspective = g.perspective;
    RowsItem item{l.center.x, l.center.y, l.center.z, l.range, l.axis.x, l.axis.y, l.axis.z, l.cosine, l.sine,
                  g.y[row], g.y[row + 1], g.depth_m[slice], g.depth_m[slice + 1], g.x[column], g.x[column + 1],
                  std::bit_cast<float>(perspective ? 1U : 0U)};
    if (random.bits() % 32U == 0)
        for (int k = 0; k < 3; ++k) item[random.bits() % (rows_in - 1)] = random.any();
    return item;
}

void rows_host(std::span<std::uint32_t const> in, std::span<std::uint32_t> out) {
    RowsItem f;
    std::memcpy(f.data(), in.data(), sizeof f);
    using F = formula::Float<float>;
    bool const perspective = in[15] != 0;
    formula::GnRow<float> const row{formula::gn_row_border(F(f[9]), perspective), formula::gn_row_border(F(f[10]), perspective),
                                    formula::gn_slice_plane(F(f[11]), perspective), formula::gn_slice_plane(F(f[12]), perspective)};
    auto const ball = formula::gn_ready_ball(formula::Vec3<float>(f[0], f[1], f[2]), F(f[3]), perspective);
    auto const spot = formula::gn_ready_spot(ball, formula::Vec3<float>(f[4], f[5], f[6]), F(f[7]), F(f[8]), perspective);
    auto const of_ball = formula::gn_ball_row(ball, row, perspective);
    auto const of_spot = formula::gn_spot_row(spot, row, perspective);
    out[0] = gn_touches(of_ball, F(f[13]), F(f[14])).v ? 1U : 0U;
    out[1] = gn_touches(of_spot, F(f[13]), F(f[14])).v ? 1U : 0U;
    out[2] = (spot.outline.first.upper.v ? 1U : 0U) | (spot.outline.second.upper.v ? 2U : 0U);
    float const values[29] = {of_ball.low.v, of_ball.high.v, of_spot.low.v, of_spot.high.v, ball.x.low.v, ball.x.high.v,
                              ball.y.low.v, ball.y.high.v, ball.cap_low_scale.v, ball.cap_high_scale.v, row.top.secant.v,
                              row.top.cosine.v, row.near.scale.v, row.near.inverse.v, spot.cone.slack.v, spot.cone.depth.low.v,
                              spot.cone.depth.high.v, spot.side[0].bound.v, spot.side[1].bound.v, spot.side[2].bound.v,
                              spot.side[3].bound.v, spot.side[0].first.at_eye.v, spot.side[1].second.slope.v,
                              spot.outline.first.start.v, spot.outline.first.lean.v, spot.outline.first.off.v,
                              spot.outline.second.start.v, spot.outline.second.lean.v, spot.ready.x.high.v};
    std::memcpy(out.data() + 3, values, sizeof values);
}

void check_rows(std::size_t chunks) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::ParityKernel const kernel{"parity_rows", vulkan::test::parity_rows_comp, rows_in, rows_out};
    HardFloats random(21);
    test::Draw draw{7};
    std::vector<vulkan::test::Agreement> total(rows_out);
    std::uint64_t touched[2] = {0, 0};
    std::size_t tried = 0;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        std::vector<RowsItem> items(50'000);
        for (RowsItem& item : items) item = rows_item(draw, random);
        tried += items.size();
        std::span<std::uint32_t const> const words{reinterpret_cast<std::uint32_t const*>(items.data()), items.size() * rows_in};
        auto const results = vulkan::test::run_on_device(*device, kernel, words);
        auto const columns = vulkan::test::compare(kernel, words, results, rows_host);
        for (std::size_t c = 0; c < rows_out; ++c) {
            if (total[c].differing == 0) total[c].first = columns[c].first;
            total[c].compared += columns[c].compared;
            total[c].differing += columns[c].differing;
            total[c].flushed += columns[c].flushed;
        }
        for (std::size_t i = 0; i < items.size(); ++i)
            for (std::size_t k = 0; k < 2; ++k) touched[k] += results[i * rows_out + k];
    }
    for (std::size_t c = 0; c < rows_out; ++c) {
        CAPTURE(c, total[c].compared, total[c].flushed, total[c].first);
        CHECK(total[c].differing == 0);
        CHECK(total[c].compared > tried * 95 / 100);
    }
    for (std::uint64_t const n : touched) CHECK((n > tried / 20 && n < tried * 19 / 20));
    CHECK(device->take_messages() == "");
}

}  // namespace

TEST_CASE("rows of balls and spots have the same bits on the device", "[vulkan][parity]") { check_rows(1); }
TEST_CASE("rows of balls and spots have the same bits on the device, a million hard ones", "[vulkan][parity][.full]") { check_rows(20); }
