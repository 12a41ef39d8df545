#include "parity.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/projection.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/shadow.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include "shaders/parity_lookup_comp.hpp"

#include <cmath>
#include <cstddef>

namespace {

using namespace gnomon;
using vulkan::test::HardFloats;

constexpr std::int32_t lookup_side_px = 128;
constexpr std::size_t lookup_texels = std::size_t{lookup_side_px} * lookup_side_px;

/// As in parity_lookup.comp.
struct LookupCase {
    shadow::MapView map;
    formula::GnShadowConfig config;
};
static_assert(sizeof(LookupCase) == 192);

struct LookupItem {
    math::vec3 position;
    math::vec3 normal;
    std::uint32_t index;
};
static_assert(sizeof(LookupItem) == 28);

/// Sun, spot and a cube's face, both ways of depth, both formats, with settings that reach every branch.
struct LookupWorld {
    std::vector<math::View> views;
    std::vector<LookupCase> cases;
    std::vector<shadow::LookupConfig> configs;
    std::vector<float> depths;

    [[nodiscard]] shadow::Texels<float> texels(std::size_t i) const {
        return {depths.data() + i * lookup_texels, lookup_side_px};
    }
};

math::View lookup_view(std::size_t kind, math::Depth depth) {
    math::ivec2 const size(lookup_side_px, lookup_side_px);
    if (kind == 0) {
        projection::DirectionalConfig config;
        config.size_px = size;
        config.depth = depth;
        math::Aabb const box{math::vec3(-10.0F), math::vec3(10.0F)};
        return projection::directional_view(math::dvec3(-0.45, -0.8, -0.4), box, {}, config).value();
    }
    if (kind == 1) {
        projection::SpotConfig config;
        config.position_m = math::dvec3(3.0, 12.0, -4.0);
        config.direction = math::dvec3(-0.3, -1.0, 0.2);
        config.outer_cone_rad = 0.9;
        config.near_m = 0.5;
        config.far_m = 60.0;
        config.size_px = size;
        config.depth = depth;
        return projection::spot_view(config).value();
    }
    projection::CubeConfig config;
    config.position_m = math::dvec3(1.0, 5.0, -2.0);
    config.size_px = lookup_side_px;
    config.margin_px = 2.5;
    config.depth = depth;
    return projection::cube_views(config).value()[3];
}

LookupWorld make_lookup_world() {
    LookupWorld world;
    HardFloats random(3);
    for (std::size_t i = 0; i < 36; ++i) {
        math::Depth const depth = i % 2 == 0 ? math::Depth::reversed : math::Depth::forward;
        shadow::LookupConfig config;
        config.taps = 1 + static_cast<int>(i % 7);
        config.bias.automatic = i % 5 != 0;
        config.bias.receiver_plane = i % 4 != 0;
        config.bias.constant = i % 6 == 0 ? 0.7F : 0.0F;
        config.bias.slope = i % 9 == 0 ? 0.3F : 0.0F;
        config.bias.normal_offset = i % 8 == 0 ? 1.25F : 0.0F;
        config.bias.unit = i % 12 == 0 ? shadow::BiasUnit::metres : shadow::BiasUnit::texels;
        world.views.push_back(lookup_view(i / 2 % 3, depth));
        auto const format = i % 10 < 5 ? shadow::Format::f32 : shadow::Format::unorm16;
        world.cases.push_back({shadow::make_map_view(world.views.back(), math::dvec3(0.0), format),
                               shadow::formula_config(config)});
        world.configs.push_back(config);
    }
    world.depths.resize(lookup_texels * world.cases.size());
    for (float& depth : world.depths) depth = random.between(0.0F, 1.0F);
    return world;
}

math::vec3 unit_normal(HardFloats& random, math::vec3 const& toward) {
    math::vec3 n{random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F)};
    switch (random.bits() % 6U) {
        case 0: n = math::vec3(0.0F, 1.0F, 0.0F); break;
        case 1: n = toward; break;
        case 2: n = math::vec3(-toward.y, toward.x, n.z * 1e-6F); break;  // nearly edge on
        default: break;
    }
    float const length = std::sqrt(glm::dot(n, n));
    return length > 0.01F ? n * (1.0F / length) : math::vec3(0.0F, 0.0F, 1.0F);
}

/// On the border, or the middle, of a texel, or some float beside it.
math::vec3 at_a_texel(HardFloats& random, math::View const& view) {
    double const x = random.bits() % (2U * lookup_side_px) * 0.5;
    double const y = random.bits() % (2U * lookup_side_px) * 0.5;
    math::PixelRay const ray = math::pixel_ray(view, math::dvec2(x, y));
    math::dvec3 const p = view.eye_m + ray.start_m + ray.step * static_cast<double>(random.between(0.5F, 30.0F));
    math::vec3 const f = math::to_float(p);
    return math::vec3{random.beside(f.x), random.beside(f.y), random.beside(f.z)};
}

/// Points of triangles with their normals, as a picture's samples are.
std::vector<LookupItem> scene_items() {
    std::vector<LookupItem> items;
    for (char const* name : {"town", "atrium"}) {
        auto const scene = scene::make_procedural({.name = name});
        REQUIRE(scene);
        scene::Geometry const g = scene::flatten(*scene);
        HardFloats random(4);
        for (std::size_t k = 0; k < 100'000; ++k) {
            std::size_t const t = random.bits() % (g.indices.size() / 3) * 3;
            math::vec3 const a = g.positions[g.indices[t]];
            math::vec3 const ab = g.positions[g.indices[t + 1]] - a;
            math::vec3 const ac = g.positions[g.indices[t + 2]] - a;
            math::vec3 const n = glm::cross(ab, ac);
            float const length = std::sqrt(glm::dot(n, n));
            if (!(length > 0.0F)) continue;
            float const u = random.between(0.0F, 0.5F);
            items.push_back({a + ab * u + ac * random.between(0.0F, 0.5F), n * (1.0F / length), 0});
        }
    }
    return items;
}

LookupItem make_item(HardFloats& random, LookupWorld const& world, std::vector<LookupItem> const& scene) {
    auto const index = static_cast<std::uint32_t>(random.bits() % world.cases.size());
    math::View const& view = world.views[index];
    math::vec3 const toward = world.cases[index].map.back;
    LookupItem item{at_a_texel(random, view), unit_normal(random, toward), index};
    switch (random.bits() % 8U) {
        case 0: item.position = math::vec3{random.any(), random.any(), random.any()}; break;
        case 1:
        case 2:
            item = scene[random.bits() % scene.size()];
            item.index = index;
            break;
        case 3:
            item.position = math::vec3{random.between(-12.0F, 12.0F), random.between(-12.0F, 12.0F),
                                       random.between(-12.0F, 12.0F)};
            break;
        default: break;
    }
    return item;
}

/// A texel that an item reads holds just what it is compared with, or a float beside it: ties.
void put_ties(HardFloats& random, LookupWorld& world, std::span<LookupItem const> items) {
    for (LookupItem const& item : items) {
        shadow::MapView const& map = world.cases[item.index].map;
        auto const ready = shadow::prepare(map, item.position, item.normal, world.configs[item.index]);
        if (ready.faces_away || !ready.receiver.in_front) continue;
        std::int32_t const x = shadow::taps_at(ready.receiver.texel.x, world.configs[item.index].taps).first;
        std::int32_t const y = shadow::taps_at(ready.receiver.texel.y, world.configs[item.index].taps).first;
        if (x < 0 || y < 0 || x >= lookup_side_px || y >= lookup_side_px) continue;
        float const depth = shadow::plane_depth(ready, x, y);
        if (!(depth > 0.0F && depth < 1.0F)) continue;
        auto const texel = static_cast<std::size_t>(y) * lookup_side_px + static_cast<std::size_t>(x);
        world.depths[item.index * lookup_texels + texel] = random.beside(depth);
    }
}

void lookup_host(LookupWorld const& world, LookupItem const& item, std::span<std::uint32_t> out) {
    auto const bits = [](formula::Float<float> x) { return std::bit_cast<std::uint32_t>(x.v); };
    shadow::MapView const& map = world.cases[item.index].map;
    formula::GnShadowConfig const& config = world.cases[item.index].config;
    formula::Vec3<float> const position(item.position);
    formula::Vec3<float> const normal(item.normal);
    auto const at = gn_receiver_at(map, position, normal);
    auto const ready = gn_prepare(map, position, normal, config);
    auto const seen = shadow::look_up(map, world.texels(item.index), item.position, item.normal, world.configs[item.index]);
    auto const corner = gn_clip_of_corner(map.clip_from_relative, formula::Vec3<float>(item.position - map.eye));
    bool const compares = at.in_front.v && !ready.faces_away.v && ready.at.in_front.v;
    std::uint32_t const results[] = {
        (at.in_front.v ? 1U : 0U) | (ready.faces_away.v ? 2U : 0U) | (compares ? 4U : 0U),
        bits(at.texel.x), bits(at.texel.y), bits(at.depth), bits(at.gradient.x), bits(at.gradient.y),
        bits(at.tan_angle), bits(at.depth_per_m),
        static_cast<std::uint32_t>(gn_taps_at(ready.at.texel.x, config.taps).first.v),
        bits(ready.depth), bits(seen.visibility), bits(seen.bias_m),
        bits(corner.x), bits(corner.y), bits(corner.z), bits(corner.w)};
    std::copy(std::begin(results), std::end(results), out.begin());
}

constexpr char const* lookup_names[] = {"flags", "texel.x", "texel.y", "depth", "gradient.x", "gradient.y",
                                        "tan_angle", "depth_per_m", "first tap", "biased depth", "visibility",
                                        "bias_m", "corner.x", "corner.y", "corner.z", "corner.w"};

template <class T>
std::span<std::uint32_t const> as_words(std::vector<T> const& from) {
    return {reinterpret_cast<std::uint32_t const*>(from.data()), from.size() * sizeof(T) / 4};
}

}  // namespace

TEST_CASE("a million lookups have the same bits on the device, ties and texel borders too", "[vulkan][parity]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::test::ParityKernel const kernel{"parity_lookup", vulkan::test::parity_lookup_comp, 7, 16};
    LookupWorld world = make_lookup_world();
    auto const scene = scene_items();
    HardFloats random(5);
    std::vector<vulkan::test::Agreement> total(kernel.out);
    std::uint64_t partly = 0;
    for (int chunk = 0; chunk < 8; ++chunk) {
        std::vector<LookupItem> items(125'000);
        for (LookupItem& item : items) item = make_item(random, world, scene);
        put_ties(random, world, items);
        std::span<std::uint32_t const> const shared[] = {as_words(world.cases), as_words(world.depths)};
        auto const results = vulkan::test::run_on_device(*device, kernel, as_words(items), shared);
        auto const columns = vulkan::test::compare(kernel, as_words(items), results, [&](auto in, auto out) {
            LookupItem item;
            std::memcpy(&item, in.data(), sizeof item);
            lookup_host(world, item, out);
        });
        for (std::size_t c = 0; c < columns.size(); ++c) {
            total[c].compared += columns[c].compared;
            total[c].differing += columns[c].differing;
            total[c].flushed += columns[c].flushed;
        }
        for (std::size_t i = 10; i < results.size(); i += 16)
            partly += results[i] != 0 && results[i] != std::bit_cast<std::uint32_t>(1.0F) ? 1U : 0U;
    }
    for (std::size_t c = 0; c < total.size(); ++c) {
        CAPTURE(lookup_names[c], total[c].compared, total[c].flushed);
        CHECK(total[c].differing == 0);
        CHECK(total[c].compared > 980'000);
    }
    CHECK(partly > 100'000);  // of the lookups, neither all lit nor all in shadow
    CHECK(device->take_messages() == "");
}

TEST_CASE("shared structs lie in the shader as in C++", "[vulkan][parity]") {
    using shadow::MapView;
    using formula::GnShadowConfig;
    auto const members = [](std::string_view name) {
        return vulkan::members_of(vulkan::test::parity_lookup_comp, name);
    };
    std::vector<vulkan::ShaderMember> const map = {
        {"clip_from_relative", offsetof(MapView, clip_from_relative), sizeof(MapView::clip_from_relative)},
        {"eye", offsetof(MapView, eye), sizeof(MapView::eye)},
        {"near_m", offsetof(MapView, near_m), 4},
        {"right", offsetof(MapView, right), sizeof(MapView::right)},
        {"depth_scale", offsetof(MapView, depth_scale), 4},
        {"up", offsetof(MapView, up), sizeof(MapView::up)},
        {"depth_offset", offsetof(MapView, depth_offset), 4},
        {"back", offsetof(MapView, back), sizeof(MapView::back)},
        {"half_code", offsetof(MapView, half_code), 4},
        {"texel", offsetof(MapView, texel), sizeof(MapView::texel)},
        {"size_px", offsetof(MapView, size_px), sizeof(MapView::size_px)},
        {"perspective", offsetof(MapView, perspective), 4},
        {"reversed", offsetof(MapView, reversed), 4},
        {"unused_a", offsetof(MapView, unused_a), 4},
        {"unused_b", offsetof(MapView, unused_b), 4}};
    CHECK(members("GnShadowMap") == map);
    std::vector<vulkan::ShaderMember> const config = {
        {"taps", offsetof(GnShadowConfig, taps), 4},
        {"automatic", offsetof(GnShadowConfig, automatic), 4},
        {"receiver_plane", offsetof(GnShadowConfig, receiver_plane), 4},
        {"in_texels", offsetof(GnShadowConfig, in_texels), 4},
        {"constant", offsetof(GnShadowConfig, constant), 4},
        {"slope", offsetof(GnShadowConfig, slope), 4},
        {"normal_offset", offsetof(GnShadowConfig, normal_offset), 4},
        {"max_tan", offsetof(GnShadowConfig, max_tan), 4}};
    CHECK(members("GnShadowConfig") == config);
    auto const both = members("Case");
    REQUIRE(both.size() == 2);
    CHECK(both[1].offset == offsetof(LookupCase, config));
}
