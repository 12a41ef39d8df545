#include "parity.hpp"

#include <gnomon/cascade.hpp>
#include <gnomon/check/check.hpp>

#include "shaders/parity_cascade_comp.hpp"

#include <array>
#include <cstddef>

namespace {

namespace cascade_parity {

using namespace gnomon;
using vulkan::test::HardFloats;

constexpr std::size_t in_words = 8;
constexpr std::size_t out_words = 12;
constexpr std::int32_t map_px = 32;
using Item = std::array<std::uint32_t, in_words>;

/// As the shader declares it.
struct Case {
    formula::GnScroll scroll;
    cascade::CascadeDepths depths;
    cascade::CascadeMaps maps;
};
static_assert(sizeof(Case) == 32 + 80 + 272);

/// 32 x 32 depths of 16 bits, as a device reads them, and then of floats.
struct Texels {
    std::vector<float> depths;
    std::size_t first = 0;

    friend formula::Float<float> gn_texel(Texels const& t, formula::Int<float> const& x, formula::Int<float> const& y) {
        return t.depths[t.first + static_cast<std::size_t>(y.v * map_px + x.v)];
    }
};

struct World {
    std::vector<Case> cases;
    Texels texels;
};

World make_world(HardFloats& random) {
    World world;
    for (std::uint32_t i = 0; i < 2048; ++i) {
        std::uint32_t const code = random.bits() % 4U == 0 ? 65535U : random.bits() % 65536U;
        float const depth = static_cast<float>(random.bits() >> 8U) * 0x1p-24F;
        world.texels.depths.push_back(i < 1024                  ? static_cast<float>(code) / 65535.0F
                                      : random.bits() % 4U == 0 ? 1.0F
                                                                : depth);
    }
    for (std::uint32_t i = 0; i < 64; ++i) {
        cascade::CascadeConfig config;
        config.splits.far_m = 10.0 + static_cast<double>(random.bits() % 1000U);
        config.splits.count = 1 + i % 8;
        config.splits.fade = 0.25;
        config.fit.depth.codes = i % 2 == 0 ? cascade::unorm16_codes : cascade::float_codes;
        math::dvec3 const eye_m(i * 100.0, 2.0, -10.0);
        auto const camera =
            math::make_perspective(
                {.eye_m = eye_m, .target_m = eye_m + math::dvec3(1.0, -0.2, 0.5), .size_px = {640, 480}})
                .value();
        auto const frame = cascade::plan(cascade::Cascades{}, config, camera).value();
        auto const move = [&](std::uint32_t most) {
            return static_cast<std::int64_t>(random.bits() % (2 * most + 1)) - most;
        };
        std::int64_t const x = move(40);
        std::int64_t const y = move(20);
        std::int64_t const z = move(i % 3 == 0 ? 10U : 60000U);
        cascade::MapScroll const by{
            {x, y, z}, config.fit.depth.codes, i % 4 < 2 ? math::Depth::forward : math::Depth::reversed};
        world.cases.push_back({cascade::shader_scroll(by, map_px, i % 2 == 0), cascade::cascade_depths(frame),
                               cascade::cascade_maps(frame, {eye_m})});
    }
    return world;
}

/// A texel and a code, a depth at or beside a split, a point near a map's border; hard numbers too.
Item make_item(HardFloats& random, World const& world) {
    std::uint32_t const index = random.bits() % static_cast<std::uint32_t>(world.cases.size());
    Case const& c = world.cases[index];
    std::uint32_t const k = random.bits() % c.maps.count;
    float depth = random.bits() % 2U == 0 ? c.depths.end_m[k] : c.depths.blend_m[k];
    depth = random.bits() % 2U == 0 ? random.beside(depth) : depth * random.between(0.3F, 1.5F);
    if (random.bits() % 16U == 0) depth = random.any();
    formula::GnCascadeMap const& map = c.maps.map[k];
    float point[3];
    float const borders[4] = {0.0F, 2.0F, 18.0F, 512.0F};
    for (int a = 0; a < 3; ++a) {
        float const target = a == 2                    ? random.between(-0.1F, 1.1F)
                             : random.bits() % 2U == 0 ? borders[random.bits() % 4U]
                                                       : random.between(-20.0F, 530.0F);
        point[a] = (target - map.offset[static_cast<math::axis_t>(a)]) / (a == 2 ? map.depth_per_m : map.texels_per_m);
        if (random.bits() % 4U == 0) point[a] = random.beside(point[a]);
        if (random.bits() % 64U == 0) point[a] = random.any();
    }
    Item item{index, random.bits() % 32U, random.bits() % 32U,
              random.bits() % 8U == 0 ? (random.bits() % 2U) * 65535U : random.bits() % 65536U,
              std::bit_cast<std::uint32_t>(depth)};
    for (std::size_t a = 0; a < 3; ++a) item[5 + a] = std::bit_cast<std::uint32_t>(point[a]);
    return item;
}

void on_host(World& world, std::span<std::uint32_t const> in, std::span<std::uint32_t> out) {
    using F = formula::Float<float>;
    using I = formula::Int<float>;
    auto const word = [](F const& x) { return std::bit_cast<std::uint32_t>(x.v); };
    auto const number = [&](std::size_t i) { return std::bit_cast<float>(in[i]); };
    Case const& c = world.cases[in[0]];
    I const x(static_cast<std::int32_t>(in[1]));
    I const y(static_cast<std::int32_t>(in[2]));
    bool const reversed = c.scroll.reversed != 0;
    world.texels.first = c.scroll.unorm16 != 0 ? 0 : 1024;
    formula::Vec3<float> const light_m(number(5), number(6), number(7));
    auto const by_depth = gn_cascade_by_depth(c.depths, F(number(4)));
    auto const by_map = gn_cascade_by_map(c.maps, light_m);
    auto const place = gn_in_cascade_map(c.maps.map[0], light_m);
    auto const code =
        gn_scrolled_code(I(static_cast<std::int32_t>(in[3])), static_cast<int>(c.scroll.add), 65535, reversed);
    std::uint32_t const results[out_words] = {word(gn_scrolled_texel(c.scroll, world.texels, x, y)),
                                              static_cast<std::uint32_t>(code.v),
                                              static_cast<std::uint32_t>(gn_toroidal(x, y.v, map_px).v),
                                              by_depth.cascade.v,
                                              by_depth.next.v,
                                              word(by_depth.blend),
                                              by_map.cascade.v,
                                              by_map.next.v,
                                              word(by_map.blend),
                                              word(place.x),
                                              word(gn_texels_within(c.maps.map[1], place)),
                                              word(gn_scrolled(F(number(4)), c.scroll.add, c.scroll.last, reversed))};
    std::copy(std::begin(results), std::end(results), out.begin());
}

void check_items(std::size_t count) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::ParityKernel const kernel{"parity_cascade", vulkan::test::parity_cascade_comp, in_words, out_words};
    HardFloats random(47);
    World world = make_world(random);
    std::vector<Item> items(count);
    for (Item& item : items) item = make_item(random, world);
    std::span<std::uint32_t const> const shared[] = {
        {reinterpret_cast<std::uint32_t const*>(world.texels.depths.data()), world.texels.depths.size()},
        {reinterpret_cast<std::uint32_t const*>(world.cases.data()), world.cases.size() * sizeof(Case) / 4}};
    std::span<std::uint32_t const> const words{items.front().data(), items.size() * in_words};
    auto const results = vulkan::test::run_on_device(*device, kernel, words, shared);
    auto const columns =
        vulkan::test::compare(kernel, words, results, [&](auto in, auto out) { on_host(world, in, out); });
    for (std::size_t c = 0; c < out_words; ++c) {
        CAPTURE(c, columns[c].compared, columns[c].flushed, columns[c].first, columns[c].worst_ulps);
        CHECK(columns[c].differing == 0);
        CHECK(columns[c].compared > count * 95 / 100);
    }
    CHECK(device->take_messages() == "");
}

}  // namespace cascade_parity

}  // namespace

TEST_CASE("scrolled texels and the choice of a cascade have the same bits on the device", "[vulkan][parity]") {
    cascade_parity::check_items(50'000);
}
TEST_CASE("scrolled texels and the choice of a cascade have the same bits on the device, a million hard ones",
          "[vulkan][parity][.full]") {
    cascade_parity::check_items(1'000'000);
}
