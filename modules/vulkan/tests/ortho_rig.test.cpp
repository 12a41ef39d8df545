#include "ortho_rig.hpp"

#include <gnomon/backend/check_ortho.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::vulkan::test {

namespace {

std::size_t texels_of(backend::TargetConfig const& config) {
    return static_cast<std::size_t>(config.size_px.x) * static_cast<std::size_t>(config.size_px.y);
}

void add(raster::OrthoStats& sum, raster::OrthoStats const& s) {
    sum.triangles += s.triangles;
    sum.not_finite += s.not_finite;
    sum.overflow += s.overflow;
    sum.outside += s.outside;
    sum.degenerate += s.degenerate;
    sum.culled += s.culled;
    sum.no_sample += s.no_sample;
    sum.drawn += s.drawn;
    sum.samples_written += s.samples_written;
}

double dotted(math::dvec3 const& a, math::dvec3 const& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
math::dvec3 crossed(math::dvec3 const& a, math::dvec3 const& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
math::dvec3 unit(math::dvec3 const& v) { return v * (1.0 / std::sqrt(dotted(v, v))); }

double signed_unit(Random& random) { return static_cast<double>(random.in(-1.0F, 1.0F)); }

}  // namespace

OrthoRig::OrthoRig(Device& device, OrthoPipelinesConfig const& config) : device_(device), rig_(device, device.gpu()) {
    auto made = OrthoPipelines::make(rig_.pipelines(), config);
    REQUIRE(made);
    pipelines_ = *std::move(made);
}

std::vector<float> OrthoRig::draw(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                                  OrthoPasses const& passes) {
    DrawList list = rig_.keep(draws);
    Target target = rig_.make(config);
    VkCommandBuffer const commands = device_.begin();
    for (auto const& layers : passes) {
        auto const counts = record_ortho(commands, pipelines_, list, target, layers);
        REQUIRE(counts);
    }
    device_.submit_and_wait();
    return rig_.read(target).depth;
}

std::vector<float> draw_ortho_on_cpu(std::span<backend::Draw const> draws, backend::TargetConfig const& config,
                                     OrthoPasses const& passes, raster::OrthoStats* sum) {
    bool const is_float = config.depth == backend::DepthFormat::f32;
    std::vector<float> depth(texels_of(config) * config.layers, 1.0F);
    std::vector<std::uint16_t> codes(texels_of(config) * config.layers, 65535);
    raster::TileWorkspace workspace;
    core::SerialExecutor executor;
    for (auto const& layers : passes)
        for (backend::OrthoLayer const& layer : layers) {
            std::vector<raster::OrthoDraw> taken;
            backend::for_each_draw(layer, draws.size(), [&](std::size_t i) {
                backend::Draw const& d = draws[i];
                taken.push_back({d.positions, d.indices, layer.origin_m, d.cull, d.alpha_test});
            });
            auto const offset = static_cast<std::ptrdiff_t>(texels_of(config) * layer.layer);
            raster::DepthTarget const target =
                is_float ? raster::DepthTarget(raster::make_image(depth.data() + offset, config.size_px.x, config.size_px.y))
                         : raster::DepthTarget(raster::make_image(codes.data() + offset, config.size_px.x, config.size_px.y));
            auto const stats = raster::ortho_pass(taken, layer.light, target, {layer.depth, layer.range, layer.load, layer.scissor},
                                                  workspace, executor);
            if (sum != nullptr) add(*sum, stats);
        }
    if (!is_float) std::transform(codes.begin(), codes.end(), depth.begin(), [](std::uint16_t c) { return static_cast<float>(c); });
    return depth;
}

OrthoDifference ortho_difference(std::span<float const> cpu, std::span<float const> gpu, float farthest) {
    OrthoDifference d;
    REQUIRE(cpu.size() == gpu.size());
    d.texels = cpu.size();
    for (std::size_t i = 0; i < cpu.size(); ++i) {
        d.most = std::max(d.most, std::abs(cpu[i] - gpu[i]));
        d.written += cpu[i] != farthest ? 1U : 0U;
        d.differing += cpu[i] == gpu[i] ? 0U : 1U;
    }
    return d;
}

math::vec3 OrthoView::position(double x_px, double y_px, double code) const {
    backend::IntegerOrtho const& light = layer.light;
    double const right = (x_px - size_px.x * 0.5) * light.texel_m;
    double const down = (y_px - size_px.y * 0.5) * light.texel_m;
    double const away = (code - last_code * 0.5) * light.depth_unit_m;
    math::dvec3 const p = light.right * right + light.down * down + light.away * away;
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

OrthoView random_view(Random& random, backend::TargetConfig const& config, double far_m, bool plain) {
    OrthoView view;
    view.size_px = config.size_px;
    view.last_code = config.depth == backend::DepthFormat::f32 ? 0x1p24 : 65535.0;
    backend::IntegerOrtho& light = view.layer.light;
    light.texel_m = plain ? 0x1p-6 : static_cast<double>(random.in(0.001F, 0.3F));
    light.depth_unit_m = plain ? 0x1p-10 : static_cast<double>(random.in(20.0F, 300.0F)) / view.last_code;
    math::dvec3 origin(0.0);
    if (plain) {
        double const whole = std::floor(far_m);
        origin = math::dvec3(whole, -whole, whole);
    } else {
        math::dvec3 a(0.0);
        math::dvec3 b(0.0);
        for (math::dvec3* v : {&a, &b, &origin}) {
            v->x = signed_unit(random);
            v->y = signed_unit(random);
            v->z = signed_unit(random);
        }
        light.right = unit(a);
        light.away = unit(crossed(light.right, b));
        light.down = crossed(light.away, light.right);
        origin = origin * far_m;
    }
    view.layer.origin_m = origin;
    auto const units = [&](math::dvec3 const& axis, double size) { return static_cast<std::int64_t>(dotted(axis, origin) / size); };
    light.origin_x = units(light.right, light.texel_m) - view.size_px.x / 2;
    light.origin_y = units(light.down, light.texel_m) - view.size_px.y / 2;
    light.origin_z = units(light.away, light.depth_unit_m) - static_cast<std::int64_t>(view.last_code * 0.5);
    return view;
}

namespace {

struct Point {
    double x, y, code;
};

/// Points at random about a view's image.
struct Points {
    Random& random;
    OrthoView const& view;

    double in(double low, double high) { return low + (high - low) * (static_cast<double>(random.next() >> 11U) * 0x1p-53); }
    Point anywhere(double margin) {
        double const x = in(-margin, view.size_px.x + margin);
        double const y = in(-margin, view.size_px.y + margin);
        double const code = in(-0.05, 1.05) * view.last_code;
        return {x, y, code};
    }
    Point close_to(Point const& a, double most) {
        double const x = a.x + in(-most, most);
        double const y = a.y + in(-most, most);
        double const code = in(-0.05, 1.05) * view.last_code;
        return {x, y, code};
    }
};

/// By kind, how far from the image the second and third corner may be.
constexpr double margins_px[] = {
    2.0, 30.0,
    900.0,     // the device's
    1'100.0,   // some the device's, some not
    8'300.0,   // about the edge of the reach
    60'000.0,  // out of it
    4e6,       // 128 bits
    1e9,
};

void shape(Point (&t)[3], Points& points, std::uint64_t kind) {
    t[0] = points.anywhere(2.0);
    for (std::size_t i = 1; i < 3; ++i) t[i] = kind < std::size(margins_px) ? points.anywhere(margins_px[kind]) : points.close_to(t[0], 20.0);
    switch (kind) {
        case 1: t[1] = points.close_to(t[0], 1.5), t[2] = points.close_to(t[0], 1.5); break;
        case 8:  // slivers
            t[1] = points.anywhere(points.random.next() % 2 == 0 ? 200.0 : 1e6);
            t[2] = points.close_to(t[0], 0.02);
            break;
        case 9:  // corners on centres: the tie rule
            for (Point& p : t) {
                p.x = std::floor(p.x) + 0.5;
                p.y = std::floor(p.y) + 0.5;
                p.code = std::floor(p.code) + 0.5;
            }
            break;
        case 10: t[2] = {(t[0].x + t[1].x) * 0.5, (t[0].y + t[1].y) * 0.5, t[1].code}; break;  // about no area
        case 11:                                                                              // steep
            for (Point& p : t) p.code = points.in(-2e6, 2e6) * points.view.last_code;
            break;
        default: break;
    }
}

}  // namespace

void add_triangle(Soup& soup, Random& random, OrthoView const& view, std::uint64_t kind) {
    Points points{random, view};
    Point t[3];
    shape(t, points, kind % ortho_kinds);
    for (Point const& p : t) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(view.position(p.x, p.y, p.code));
        float const u = random.in(-2.0F, 2.0F);
        float const v = random.in(-2.0F, 2.0F);
        soup.uv.emplace_back(u, v);
    }
}

backend::AlphaTest const* add_alpha_test(OrthoScene& scene, Random& random, Soup const& soup) {
    auto& texels = scene.textures.emplace_back();
    auto const side = static_cast<std::int32_t>(1 + random.next() % 9);
    for (std::int32_t i = 0; i < side * side; ++i) texels.push_back(static_cast<std::uint8_t>(random.next()));
    constexpr math::Wrap wraps[] = {math::Wrap::repeat, math::Wrap::clamp, math::Wrap::mirror};
    math::Wrap const u = wraps[random.next() % 3];
    math::Wrap const v = wraps[random.next() % 3];
    scene.tests.push_back({.uv = std::span<math::vec2 const>(soup.uv),
                           .texture = {.texels = texels, .size_px = {side, side}, .wrap_u = u, .wrap_v = v, .channels = 1}});
    return &scene.tests.back();
}

}  // namespace gnomon::vulkan::test
