// Shadows that stand still while the camera moves: measured on the maps' texels in light space, and on points of the world.

#include <gnomon/backend.hpp>
#include <gnomon/cascade.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/shadow/lookup.hpp>
#include <gnomon/shadow/map_view.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

namespace {

namespace stability {

using namespace gnomon;

constexpr std::int32_t side = 256;
constexpr std::uint32_t maps = 2;

struct Random {
    std::uint64_t state = 1;
    double unit() noexcept {
        state = state * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state >> 11U) * 0x1p-53;
    }
    double spread(double reach) noexcept { return (unit() * 2.0 - 1.0) * reach; }
};

/// A hilly ground with slanted slabs over it, about `origin_m`, and points on all of it.
struct Ground {
    math::dvec3 origin_m;
    std::vector<math::vec3> corners;
    std::vector<shadow::Surface> points;

    explicit Ground(math::dvec3 const& origin) : origin_m(origin) {
        Random random;
        auto const height = [](int x, int z) { return static_cast<float>(0.8 * std::sin(0.7 * x) + 0.6 * std::cos(0.9 * z)); };
        for (int x = -16; x < 16; ++x)
            for (int z = -16; z < 16; ++z) {
                auto const at = [&](int i, int j) { return math::vec3(6.0F * static_cast<float>(x + i), height(x + i, z + j), 6.0F * static_cast<float>(z + j)); };
                for (math::vec3 const& p : {at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)}) corners.push_back(p);
            }
        for (int i = 0; i < 250; ++i) {
            math::vec3 const middle = spread(random, 60.0, 6.0) + math::vec3(0.0F, 7.0F, 0.0F);
            math::vec3 const a = spread(random, 2.0, 2.0), b = spread(random, 2.0, 2.0);
            for (math::vec3 const& p : {middle, middle + a, middle + b, middle + a, middle + b, middle + a + b}) corners.push_back(p);
        }
        for (int i = 0; i < 1500; ++i) {
            std::size_t const t = static_cast<std::size_t>(random.unit() * static_cast<double>(corners.size() / 3)) * 3;
            auto const u = static_cast<float>(random.unit()), v = static_cast<float>(random.unit()) * (1.0F - u);
            math::vec3 const e1 = corners[t + 1] - corners[t], e2 = corners[t + 2] - corners[t];
            math::vec3 normal = glm::cross(e1, e2);
            normal = normal / std::sqrt(glm::dot(normal, normal));
            points.push_back({corners[t] + e1 * u + e2 * v, normal.y < 0.0F ? -normal : normal});
        }
    }
    static math::vec3 spread(Random& random, double aside, double up) {
        double const x = random.spread(aside);
        double const y = random.spread(up);
        double const z = random.spread(aside);
        return math::to_float(math::dvec3(x, y, z));
    }
};

/// The maps of one camera.
struct Drawn {
    cascade::CascadeFrame frame;
    std::array<std::vector<std::uint16_t>, maps> codes;
};

enum class Rounding : std::uint8_t {
    whole,  ///< As cascades are placed.
    none,   ///< As they would stand if their places were not rounded down to whole texels.
};

/// By how much rounding down moved a map, in metres along the light's axes.
math::dvec3 slip_m(cascade::CascadeFrame const& frame, math::View const& camera, std::uint32_t k) {
    std::array<math::dvec3, 8> corners = cascade::corners_in_view(camera, frame.cascades[k].depths);
    for (math::dvec3& p : corners) p = camera.eye_m - frame.anchor_m + cascade::relative_from_view(camera, p);
    cascade::LightBounds const box = cascade::bounds_in_light(frame.light, corners);
    cascade::Volume const& v = frame.cascades[k].volume;
    math::dvec3 const middle = (box.lo_m + box.hi_m) * (0.5 / v.texel_m);
    return frame.light.right * ((middle.x - std::floor(middle.x)) * v.texel_m) + frame.light.down * ((middle.y - std::floor(middle.y)) * v.texel_m);
}

class Painter {
  public:
    explicit Painter(Ground const& ground, math::Depth depth) : ground_(ground), depth_(depth), device_(executor_) {
        backend::Draw draw;
        draw.positions = std::span<math::vec3 const>(ground.corners);
        list_ = device_.keep({&draw, 1}).value();
        target_ = device_.make_target({.size_px = {side, side}, .layers = maps, .depth = backend::DepthFormat::unorm16}).value();
    }

    Drawn operator()(math::View const& camera, Rounding rounding) {
        cascade::CascadeConfig config;
        config.direction = {-0.45, -0.8, -0.37};
        config.splits.count = maps;
        config.splits.far_m = 60.0;
        config.splits.scheme = cascade::SplitScheme::uniform;
        config.fit.size_px = side;
        Drawn drawn{cascade::plan(cascade::Cascades{}, config, camera).value(), {}};
        std::array<backend::OrthoLayer, maps> layers;
        for (std::uint32_t k = 0; k < maps; ++k) {
            cascade::LightFrame const& light = drawn.frame.light;
            cascade::Volume const& v = drawn.frame.cascades[k].volume;
            layers[k].light = {light.right, light.down, light.away, v.texel_m, v.depth_unit_m, v.at.x, v.at.y, v.at.z};
            layers[k].origin_m = ground_.origin_m - drawn.frame.anchor_m;
            if (rounding == Rounding::none) layers[k].origin_m -= slip_m(drawn.frame, camera, k);
            layers[k].layer = k;
            layers[k].depth = depth_;
        }
        REQUIRE(device_.draw_ortho(list_, target_, layers).has_value());
        for (std::uint32_t k = 0; k < maps; ++k) {
            drawn.codes[k].resize(static_cast<std::size_t>(side) * side);
            REQUIRE(device_.read({target_, k, backend::Plane::depth, {0, 0, side, side}}, std::as_writable_bytes(std::span(drawn.codes[k]))).has_value());
        }
        REQUIRE(device_.finish().has_value());
        return drawn;
    }

  private:
    Ground const& ground_;
    math::Depth depth_;
    core::SerialExecutor executor_;
    raster::CpuBackend device_;
    backend::DrawListId list_;
    backend::TargetId target_;
};

struct Tally {
    std::uint64_t moves = 0;
    std::uint64_t moves_seen = 0;  ///< That changed any texel.
    std::uint64_t texels = 0;      ///< Compared.
    std::uint64_t changed = 0;
    std::uint64_t clamped = 0;     ///< At the near plane, where depths are not the casters'.
    std::uint64_t points = 0;
    std::uint64_t points_changed = 0;  ///< By more than a thousandth.
    double most = 0.0;
};

/// Compares what both show, at the same texels and depths of light space.
void compare_texels(Drawn const& a, Drawn const& b, math::Depth depth, Tally& tally) {
    std::uint64_t const before = tally.changed;
    for (std::uint32_t k = 0; k < maps; ++k) {
        cascade::Place const& at = a.frame.cascades[k].volume.at;
        cascade::Place const shift = b.frame.cascades[k].volume.at - at;
        REQUIRE(a.frame.cascades[k].volume.texel_m == b.frame.cascades[k].volume.texel_m);
        auto const unit_of = [&](Drawn const& drawn, std::size_t i) {
            std::int32_t const held = drawn.codes[k][i];
            std::int32_t const code = depth == math::Depth::reversed ? 65535 - held : held;
            tally.clamped += code == 0 ? 1U : 0U;
            return code == 65535 ? std::numeric_limits<std::int64_t>::min() : drawn.frame.cascades[k].volume.at.z + code;
        };
        for (std::int64_t y = 0; y < side; ++y)
            for (std::int64_t x = 0; x < side; ++x) {
                std::int64_t const u = x - shift.x, v = y - shift.y;
                if (u < 0 || v < 0 || u >= side || v >= side) continue;
                ++tally.texels;
                tally.changed += unit_of(a, static_cast<std::size_t>(y * side + x)) != unit_of(b, static_cast<std::size_t>(v * side + u)) ? 1U : 0U;
            }
    }
    ++tally.moves;
    tally.moves_seen += tally.changed != before ? 1U : 0U;
}

/// Looks fixed points of the world up in both, in the same map.
void compare_points(Ground const& ground, Drawn const& a, Drawn const& b, math::Depth depth, Tally& tally) {
    shadow::LookupConfig config;
    config.taps = 3;
    for (std::uint32_t k = 0; k < maps; ++k) {
        auto const view_of = [&](Drawn const& d) { return shadow::make_map_view(cascade::view_of(d.frame, k, depth), ground.origin_m, shadow::Format::unorm16); };
        shadow::MapView const before = view_of(a), now = view_of(b);
        shadow::Texels<std::uint16_t> const old_texels{a.codes[k].data(), side}, new_texels{b.codes[k].data(), side};
        auto const is_well_in = [&](shadow::MapView const& map, shadow::Surface const& s) {
            math::vec2 const t = shadow::prepare(map, s.position, s.normal, config).receiver.texel;
            return t.x > 4.0F && t.y > 4.0F && t.x < side - 4.0F && t.y < side - 4.0F;
        };
        for (shadow::Surface const& s : ground.points) {
            if (!is_well_in(before, s) || !is_well_in(now, s)) continue;
            auto const difference = static_cast<double>(shadow::look_up(before, old_texels, s.position, s.normal, config).visibility) -
                                    static_cast<double>(shadow::look_up(now, new_texels, s.position, s.normal, config).visibility);
            ++tally.points;
            tally.points_changed += std::abs(difference) > 1e-3 ? 1U : 0U;
            tally.most = std::max(tally.most, std::abs(difference));
        }
    }
}

/// The camera after each of many small moves: along the 26 ways by parts of the smallest texel, turned, and jittered by
/// parts of a pixel.
std::vector<math::View> moves_of(math::View const& camera, double texel_m) {
    Random random;
    std::vector<math::View> moved;
    for (int i = 0; i < 27; ++i) {
        math::dvec3 const way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (way == math::dvec3(0.0)) continue;
        for (double const least : {0.0, 0.5}) {
            math::View view = camera;
            view.eye_m += glm::normalize(way) * ((least + 0.5 * random.unit()) * texel_m);
            moved.push_back(view);
        }
    }
    for (int i = 0; i < 10; ++i) {
        double const least = std::pow(10.0, -0.5 * i);
        math::dvec3 const aside = camera.right * random.spread(least) + camera.up * random.spread(0.3 * least);
        moved.push_back(math::looking_along(camera, aside - camera.back, {0.0, 1.0, 0.0}));
    }
    return moved;
}

math::View camera_of(math::Lens lens, math::Depth depth, math::dvec3 const& origin_m) {
    math::dvec3 const eye = origin_m + math::dvec3(0.37, 3.1, 0.71);
    math::dvec3 const target = eye + math::dvec3(0.8, -0.2, -1.0);
    if (lens == math::Lens::perspective)
        return math::make_perspective({.eye_m = eye, .target_m = target, .size_px = {1280, 720}, .depth = depth}).value();
    return math::make_orthographic({.eye_m = eye, .target_m = target, .window_m = {-20.0, 20.0, -12.0, 12.0}, .far_m = 60.0, .size_px = {1280, 720}, .depth = depth})
        .value();
}

/// All moves of one camera, with rounding and without.
void try_camera(math::Lens lens, math::Depth depth, math::dvec3 const& origin_m, Tally& stable, Tally& unrounded) {
    Ground const ground(origin_m);
    Painter draw(ground, depth);
    math::View const camera = camera_of(lens, depth, origin_m);
    Drawn const registered = draw(camera, Rounding::whole), registered_anyhow = draw(camera, Rounding::none);
    for (math::View const& moved : moves_of(camera, registered.frame.cascades[0].volume.texel_m)) {
        Drawn const now = draw(moved, Rounding::whole);
        compare_texels(registered, now, depth, stable);
        compare_points(ground, registered, now, depth, stable);
        compare_texels(registered_anyhow, draw(moved, Rounding::none), depth, unrounded);
    }
}

TEST_CASE("no shadow texel of a scene that stands still changes when the camera moves by parts of a texel, or turns", "[pipeline][cascade][stability]") {
    Tally stable, unrounded;
    for (double const far_m : {0.0, 1e7})
        for (math::Lens const lens : {math::Lens::perspective, math::Lens::orthographic})
            for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed})
                try_camera(lens, depth, math::dvec3(far_m, 0.5 * far_m, -far_m), stable, unrounded);
    std::printf("%llu moves of the camera: %llu of %llu texels changed; of %llu looked up points %llu by more than 0.001, the most %.2g. "
                "Places that are not rounded: %llu texels, in %llu moves\n",
                static_cast<unsigned long long>(stable.moves), static_cast<unsigned long long>(stable.changed), static_cast<unsigned long long>(stable.texels),
                static_cast<unsigned long long>(stable.points), static_cast<unsigned long long>(stable.points_changed), stable.most,
                static_cast<unsigned long long>(unrounded.changed), static_cast<unsigned long long>(unrounded.moves_seen));
    CHECK(stable.texels > 10'000'000);
    CHECK(stable.changed == 0);
    CHECK(stable.clamped == 0);
    CHECK(stable.points > 100'000);
    CHECK(stable.points_changed == 0);
    CHECK(unrounded.moves_seen > unrounded.moves * 9 / 10);
}

}  // namespace stability

}  // namespace
