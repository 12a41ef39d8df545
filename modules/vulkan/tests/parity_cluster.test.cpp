#include "parity.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/cluster.hpp>
#include <gnomon/lights/formula/lookup.glsl>

#include "shaders/parity_cluster_comp.hpp"

#include <array>
#include <cstddef>
#include <limits>

namespace {

using namespace gnomon;
using vulkan::test::HardFloats;

constexpr std::size_t cluster_in = 16;
constexpr std::size_t cluster_out = 21;
using ClusterItem = std::array<std::uint32_t, cluster_in>;

/// As the shader declares it.
struct ClusterCase {
    cluster::GridTable grid;
    std::uint32_t words;
    std::uint32_t planes;
    std::uint32_t normal_n;
};
static_assert(sizeof(ClusterCase) == 80);

struct ClusterWorld {
    std::vector<cluster::Grid> grids;
    std::vector<ClusterCase> cases;
    std::vector<std::uint32_t> words;
    std::vector<std::uint32_t> planes;

    void add(math::View const& view, std::int32_t tile, cluster::SliceResult slices, std::uint32_t normal_n) {
        REQUIRE(slices.has_value());
        auto grid = cluster::make_grid(view, math::ivec2(tile, tile + 3), std::move(slices).value());
        INFO((grid ? std::string() : grid.failure().message));
        REQUIRE(grid.has_value());
        grids.push_back(std::move(grid).value());
        cluster::DepthSlices const& s = grids.back().slices();
        cases.push_back({grids.back().table(), static_cast<std::uint32_t>(words.size()), static_cast<std::uint32_t>(planes.size()), normal_n});
        words.insert(words.end(), s.words().begin(), s.words().end());
        for (float const plane : s.planes_m()) planes.push_back(std::bit_cast<std::uint32_t>(plane));
    }
};

ClusterWorld make_cluster_world() {
    ClusterWorld world;
    math::View const wide = math::make_perspective({.fov_y_rad = 1.2, .near_m = 0.1, .size_px = math::ivec2(1920, 1080)}).value();
    math::View const square =
        math::make_perspective({.fov_y_rad = 0.4, .near_m = 0.01, .far_m = 500.0, .size_px = math::ivec2(777, 777)}).value();
    math::View const flat = math::make_orthographic({.window_m = {-40.0, 25.0, -10.0, 30.0}, .near_m = -5.0, .far_m = 80.0,
                                                     .size_px = math::ivec2(640, 331)}).value();
    world.add(wide, 32, cluster::make_cubical_slices(wide, 32, 300.0), 3);
    world.add(wide, 7, cluster::make_slices(cluster::FirstThenExponentialSlices{0.1, 5.0, 200.0, 24, true}), 1);
    world.add(square, 16, cluster::make_slices(cluster::UniformDepthSlices{0.01, 500.0, 100}), 104);
    world.add(square, 64, cluster::make_slices(cluster::UniformSlices{0.01, 500.0, 1000}), 2);
    world.add(flat, 20, cluster::make_cubical_slices(flat, 20, 80.0), 3);
    return world;
}

/// A pixel and a depth at or beside a plane, a normal near an edge of the cube, a position in a box; hard numbers too.
ClusterItem cluster_item(HardFloats& random, ClusterWorld const& world) {
    std::uint32_t const index = random.bits() % static_cast<std::uint32_t>(world.grids.size());
    cluster::Grid const& grid = world.grids[index];
    auto const planes = grid.slices().planes_m();
    std::uint32_t const width = static_cast<std::uint32_t>(grid.size_px().x);
    std::uint32_t const height = static_cast<std::uint32_t>(grid.size_px().y);
    float const plane = planes[random.bits() % planes.size()];
    float depth = random.bits() % 2U == 0 ? plane : plane * random.between(0.5F, 2.0F);
    for (std::uint32_t steps = random.bits() % 4U; steps > 0; --steps) depth = random.beside(depth);
    if (random.bits() % 16U == 0) depth = random.any();
    if (random.bits() % 256U == 0) depth = std::numeric_limits<float>::quiet_NaN();
    std::uint32_t const x = random.bits() % width;
    std::uint32_t const y = random.bits() % height;
    float numbers[12];
    for (float& n : numbers) n = random.between(-1.0F, 1.0F);
    if (random.bits() % 4U == 0) numbers[1] = random.beside(random.bits() % 2U == 0 ? numbers[0] : -numbers[0]);
    if (random.bits() % 8U == 0) numbers[2] = random.beside(numbers[1]);
    float const scale = random.bits() % 2U == 0 ? 1.0F : 1000.0F;
    for (int k = 0; k < 3; ++k) {
        numbers[3 + k] *= scale;
        numbers[6 + k] = numbers[3 + k] + random.between(0.0F, scale);
        float const tenth = static_cast<float>(random.bits() % 11U) * 0.1F;
        float const share = random.bits() % 2U == 0 ? tenth : random.between(0.0F, 1.0F);
        numbers[9 + k] = random.beside(numbers[3 + k] + (numbers[6 + k] - numbers[3 + k]) * share);
    }
    if (random.bits() % 16U == 0)
        for (int k = 0; k < 3; ++k) numbers[random.bits() % 12U] = random.any();
    ClusterItem item{x, y, std::bit_cast<std::uint32_t>(depth)};
    for (std::size_t k = 0; k < 12; ++k) item[3 + k] = std::bit_cast<std::uint32_t>(numbers[k]);
    item[15] = index;
    return item;
}

void cluster_host(ClusterWorld const& world, std::span<std::uint32_t const> in, std::span<std::uint32_t> out) {
    using F = formula::Float<float>;
    using U = formula::Uint<float>;
    auto const at = [&in](std::size_t k) {
        return formula::Vec3<float>(std::bit_cast<float>(in[k]), std::bit_cast<float>(in[k + 1]), std::bit_cast<float>(in[k + 2]));
    };
    auto const word = [](F const& x) { return std::bit_cast<std::uint32_t>(x.v); };
    cluster::Grid const& grid = world.grids[in[15]];
    float const depth = std::bit_cast<float>(in[2]);
    formula::Vec3<float> const normal = at(3), lo = at(6), hi = at(9), position = at(12);
    auto const c = cluster::coordinates_at(grid, math::uvec2(in[0], in[1]), depth);
    U const cell = gn_normal_cell(normal, world.cases[in[15]].normal_n);
    U const key = formula::gn_pack_key(U(c.column), U(c.row), U(c.slice), cell);
    auto const image = gn_position_at(grid.table(), F(static_cast<float>(in[0]) + 0.5F), F(static_cast<float>(in[1]) + 0.5F), F(depth));
    U const bits = gn_position_bits(position, lo, hi);
    formula::GnClusterCounts const counts{grid.table().columns, grid.table().rows, grid.slices().count()};
    U const looked_up(cluster::slice_at(grid.slices(), depth));
    U const dense = formula::gn_cluster_index(counts, U(c.column), U(c.row), looked_up);
    std::uint32_t const results[cluster_out] = {
        c.column, c.row, c.slice, cluster::cluster_at(grid, math::uvec2(in[0], in[1]), depth), cell.v, key.v,
        (gn_key_row(key) ^ gn_key_column(key) << 8 ^ gn_key_slice(key) << 16 ^ gn_key_cell(key) << 26).v,
        formula::gn_wide_key_tile(U(c.column), U(c.row)).v, formula::gn_wide_key_inner(U(c.slice), cell).v,
        word(image.x), word(image.y), word(image.z), bits.v, word(gn_parts_low(bits, lo.x, hi.x)),
        word(gn_parts_high(bits >> 10, lo.y, hi.y)), word(gn_part_begin(lo.z, hi.z, F(7.0F))), word(gn_along(position, normal)),
        looked_up.v, dense.v, formula::gn_plane_word(U(in[15]), U(7U), dense).v, formula::gn_index_of_pair(U(in[12]), U(in[0])).v};
    std::copy(std::begin(results), std::end(results), out.begin());
}

void check_clusters(std::size_t chunks) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::ParityKernel const kernel{"parity_cluster", vulkan::test::parity_cluster_comp, cluster_in, cluster_out};
    ClusterWorld const world = make_cluster_world();
    std::span<std::uint32_t const> const shared[] = {
        {reinterpret_cast<std::uint32_t const*>(world.cases.data()), world.cases.size() * sizeof(ClusterCase) / 4}, world.words, world.planes};
    HardFloats random(31);
    std::vector<vulkan::test::Agreement> total(cluster_out);
    std::size_t tried = 0;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        std::vector<ClusterItem> items(100'000);
        for (ClusterItem& item : items) item = cluster_item(random, world);
        tried += items.size();
        std::span<std::uint32_t const> const words{items.front().data(), items.size() * cluster_in};
        auto const results = vulkan::test::run_on_device(*device, kernel, words, shared);
        auto const columns = vulkan::test::compare(kernel, words, results, [&](auto in, auto out) { cluster_host(world, in, out); });
        for (std::size_t c = 0; c < cluster_out; ++c) {
            if (total[c].differing == 0) total[c].first = columns[c].first;
            total[c].compared += columns[c].compared;
            total[c].differing += columns[c].differing;
            total[c].flushed += columns[c].flushed;
        }
    }
    for (std::size_t c = 0; c < cluster_out; ++c) {
        CAPTURE(c, total[c].compared, total[c].flushed, total[c].first);
        CHECK(total[c].differing == 0);
        CHECK(total[c].compared > tried * 95 / 100);
    }
    CHECK(device->take_messages() == "");
}

}  // namespace

TEST_CASE("slices, keys, bounds and the lookup have the same bits on the device", "[vulkan][parity]") { check_clusters(1); }
TEST_CASE("slices, keys, bounds and the lookup have the same bits on the device, a million hard ones", "[vulkan][parity][.full]") {
    check_clusters(10);
}
