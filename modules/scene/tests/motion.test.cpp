// Skins, morph targets and clips of glTF files: read, posed, written. The oracles are written apart: matrices by GLM,
// sums in long double, tables from the specification's formulas.
#include "motion_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/pose.hpp>
#include <gnomon/scene/write.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::check;
using namespace fixture;

namespace {

scene::Scene moving(scene::LoadConfig const& config = {}) {
    auto result = load(moving_file(), config);
    CAPTURE(result ? std::string() : result.failure().message);
    REQUIRE(result.has_value());
    auto const valid = scene::validate(*result);
    CAPTURE(valid ? std::string() : valid.failure().message);
    REQUIRE(valid.has_value());
    return std::move(result).value();
}

using Quad = std::array<long double, 4>;

/// Rotation of v by q, as q v q* written out with two cross products.
math::dvec3 turned(Quad const& q, math::dvec3 const& v) {
    auto const cross = [](std::array<long double, 3> const& a, std::array<long double, 3> const& b) {
        return std::array<long double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    std::array<long double, 3> const u{q[0], q[1], q[2]};
    std::array<long double, 3> const p{v.x, v.y, v.z};
    auto const t = cross(u, p);
    auto const tt = cross(u, t);
    math::dvec3 out;
    for (int i = 0; i < 3; ++i)
        out[i] = static_cast<double>(p[static_cast<std::size_t>(i)] + 2 * (q[3] * t[static_cast<std::size_t>(i)] + tt[static_cast<std::size_t>(i)]));
    return out;
}

/// The shorter arc by the textbook's sines, in long double.
Quad oracle_slerp(Quad const& a, Quad b, long double t) {
    long double dot = 0;
    for (std::size_t i = 0; i < 4; ++i) dot += a[i] * b[i];
    if (dot < 0)
        for (long double& x : b) x = -x;
    long double const w = std::acos(std::min(std::abs(dot), 1.0L));
    Quad out;
    for (std::size_t i = 0; i < 4; ++i)
        out[i] = w < 1e-6L ? a[i] + t * (b[i] - a[i]) : (std::sin((1 - t) * w) * a[i] + std::sin(t * w) * b[i]) / std::sin(w);
    return out;
}

double distance(math::vec3 const& a, math::dvec3 const& b) { return glm::length(math::to_double(a) - b); }

}  // namespace

TEST_CASE("everything that moves is read as the file has it", "[scene][motion]") {
    scene::Scene const s = moving();
    CHECK(s.notes == scene::Notes{});
    CHECK(s.file_scenes == std::vector<std::string>{"all", "prop"});
    REQUIRE(s.nodes.size() == 3);  // root, tip, arm: the others stand still in one of these or in the world
    CHECK(s.nodes[0].name == "root");
    CHECK(s.nodes[1].name == "tip");
    CHECK(s.nodes[1].parent == 0);
    CHECK(s.nodes[2].name == "arm");
    CHECK(s.nodes[2].parent == scene::none);
    REQUIRE(s.instances.size() == 2);
    CHECK(s.instances[0].skin == 0);
    CHECK(s.instances[0].node == scene::none);
    CHECK(s.instances[1].node == 2);
    CHECK(s.instances[1].node_from_mesh[3] == math::dvec4(0.0, 0.0, 5.0, 1.0));
    CHECK(s.instances[1].world_from_mesh[3] == math::dvec4(10.0, 0.0, 5.0, 1.0));
    CHECK(s.instances[1].weights == std::vector<float>{0.5F, 0.0F});
    CHECK(s.meshes[1].weights == std::vector<float>{0.0F, 0.25F});
    CHECK(s.cameras[0].node == 2);
    CHECK(s.cameras[0].eye_m == math::dvec3(10.0, 0.0, 1.0));
    CHECK(s.lights[0].node == 2);
    REQUIRE(s.skins.size() == 1);
    CHECK(s.skins[0].joints == std::vector<std::uint32_t>{0, 1});
    CHECK(s.skins[0].inverse_bind[1][3] == math::vec4(0.0F, -1.0F, 0.0F, 1.0F));
    scene::Primitive const& p = s.meshes[0].primitives[0];
    CHECK(p.influences == 4);
    REQUIRE(p.joints.size() == p.positions.size() * 4);
    for (std::uint16_t const joint : p.joints) CHECK(joint <= 1);  // the 200 had weight 0
    scene::Primitive const& m = s.meshes[1].primitives[0];
    REQUIRE(m.morph_targets.size() == 2);
    for (std::size_t v = 0; v < m.positions.size(); ++v) {
        bool const is_corner_2 = m.positions[v] == math::vec3(1.0F, 1.0F, 0.0F);
        CHECK(m.morph_targets[1].positions[v] == (is_corner_2 ? math::vec3(-1.0F, 0.0F, 0.0F) : math::vec3(0.0F)));
    }
    REQUIRE(s.animations.size() == 2);
    CHECK(scene::find_clip(s, "second") == 1);
    CHECK(scene::find_clip(s, "third") == scene::none);
    REQUIRE(s.animations[0].channels.size() == 4);
    CHECK(s.animations[0].channels[2].instance == 1);
    CHECK(s.animations[0].channels[2].node == scene::none);
    CHECK(s.animations[0].channels[3].values[5] == 1.0F);
    CHECK(scene::duration_s(s.animations[0]) == 3.0);
}

TEST_CASE("a scene is asked for by its name, and what it does not reach stays out", "[scene][motion]") {
    scene::LoadConfig config;
    config.scene_name = "prop";
    scene::Scene const s = moving(config);
    CHECK(s.name == "prop");
    CHECK(s.instances.size() == 1);
    CHECK(s.skins.empty());
    CHECK(s.nodes.size() == 1);
    CHECK(s.notes.dropped_channels == 2);  // those of the joints
    CHECK(s.animations[0].channels.size() == 2);
    config.scene_name = "no such";
    auto const refused = load(moving_file(), config);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.failure().code == scene::SceneError::bad_config);
    CHECK(refused.failure().message.find("'prop'") != std::string::npos);
}

TEST_CASE("skinned and morphed vertices stand where an oracle puts them, at any time", "[scene][motion]") {
    scene::Scene const s = moving();
    for (double const t : {0.0, 0.5, 0.75, 1.0, 1.7, 2.5, 2.999}) {
        CAPTURE(t);
        scene::Pose const pose = scene::pose_at(s, {t, 0, false});
        scene::Geometry const g = scene::flatten(s, pose, {math::dvec3(0.0)});
        // Keys at 0.5, 1, 3 s.
        auto const part = [&](double from, double to) { return std::clamp((t - from) / (to - from), 0.0, 1.0); };
        bool const second = t >= 1.0;
        double const u = second ? part(1.0, 3.0) : part(0.5, 1.0);
        math::dvec3 const root = second ? math::dvec3(4.0 * u, 2.0, 0.0) : math::dvec3(0.0, 2.0 * u, 0.0);
        // The spline about z: value (z, w) from (0,1) to (1,0) and back, tangents (+0.1 in x, unused) and -0.1 in z out.
        double const length = second ? 2.0 : 0.5;
        double const h00 = 2 * u * u * u - 3 * u * u + 1;
        double const h10 = u * u * u - 2 * u * u + u;
        double const h01 = -2 * u * u * u + 3 * u * u;
        double const h11 = u * u * u - u * u;
        bool const between = t >= 0.5 && t < 3.0;
        double z = second ? 1.0 : 0.0;
        double w = second ? 0.0 : 1.0;
        if (between) {
            z = h00 * (second ? 1.0 : 0.0) + h10 * length * static_cast<double>(-0.1F) + h01 * (second ? 0.0 : 1.0) + h11 * length * static_cast<double>(0.1F);
            w = h00 * (second ? 0.0 : 1.0) + h01 * (second ? 1.0 : 0.0);
        }
        double const norm = std::sqrt(z * z + w * w);
        Quad const q{0.0L, 0.0L, z / norm, w / norm};
        scene::Primitive const& p = s.meshes[0].primitives[0];
        for (std::size_t v = 0; v < p.positions.size(); ++v) {
            math::dvec3 const rest = math::to_double(p.positions[v]);
            math::dvec3 const by_root = root + rest;
            math::dvec3 const by_tip = root + math::dvec3(0.0, 1.0, 0.0) + turned(q, rest - math::dvec3(0.0, 1.0, 0.0));
            bool const low = rest.y == 0.0;
            CHECK(distance(g.positions[v], low ? by_root : by_root * 0.2 + by_tip * 0.8) < 1e-6);
        }
        // Weights step: (0, 1) (0.5, 0.25) (1, 0). The arm turns about y by half a turn and back.
        double const w0 = t < 1.0 ? 0.0 : t < 3.0 ? 0.5 : 1.0;
        double const w1 = t < 1.0 ? 1.0 : t < 3.0 ? 0.25 : 0.0;
        Quad const arm = second ? oracle_slerp({0, 1, 0, 0}, {0, 0, 0, 1}, u) : oracle_slerp({0, 0, 0, 1}, {0, 1, 0, 0}, u);
        scene::Primitive const& m = s.meshes[1].primitives[0];
        for (std::size_t v = 0; v < m.positions.size(); ++v) {
            math::dvec3 const morphed = math::to_double(m.positions[v]) + math::to_double(m.morph_targets[0].positions[v]) * w0 +
                                        math::to_double(m.morph_targets[1].positions[v]) * w1 + math::dvec3(0.0, 0.0, 5.0);
            CHECK(distance(g.positions[p.positions.size() + v], turned(arm, morphed) + math::dvec3(10.0, 0.0, 0.0)) < 2e-6);
        }
    }
}

TEST_CASE("at rest skins and default weights are applied", "[scene][motion]") {
    scene::Scene const s = moving();
    scene::Geometry const g = scene::flatten(s);
    scene::Primitive const& p = s.meshes[0].primitives[0];
    // The joints stand as they were bound, so the body's vertices are where the file has them; its node's 100 m count nothing.
    for (std::size_t v = 0; v < p.positions.size(); ++v) CHECK(distance(g.positions[v], math::to_double(p.positions[v])) < 1e-6);
    scene::Primitive const& m = s.meshes[1].primitives[0];
    CHECK(g.positions[p.positions.size()].z == 5.0F + 0.5F * m.morph_targets[0].positions[0].z);
}

TEST_CASE("rotations go along the shorter arc at even speed, to the last bits of a double", "[scene][motion]") {
    for_all(cases(300), integers(0, 1000000), integers(0, 1000000), integers(0, 1000), [](int i, int j, int k) {
        auto const unit = [](int seed) {
            std::array<float, 4> q{};
            float norm = 0.0F;
            for (std::size_t c = 0; c < 4; ++c) {
                q[c] = static_cast<float>(std::sin(seed * 0.7 + static_cast<double>(c) * (1.3 + seed * 1e-3)));
                norm += q[c] * q[c];
            }
            for (float& x : q) x /= std::sqrt(norm);
            return q;
        };
        std::array<float, 4> const a = unit(i);
        std::array<float, 4> const b = k % 3 == 0 ? unit(i + (j % 2)) : unit(j);
        scene::Scene s;
        s.nodes.resize(1);
        s.animations.resize(1);
        scene::AnimationChannel c;
        c.node = 0;
        c.path = scene::AnimationPath::rotation;
        c.times_s = {0.0F, 1.0F};
        c.values = {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
        s.animations[0].channels = {c};
        double const t = k / 1000.0;
        math::dvec4 const got = scene::pose_at(s, {t, 0, false}).parent_from_node[0].rotation;
        auto const widened = [](std::array<float, 4> const& q) {
            Quad w{};
            long double norm = 0;
            for (std::size_t n = 0; n < 4; ++n) norm += static_cast<long double>(q[n]) * static_cast<long double>(q[n]);
            for (std::size_t n = 0; n < 4; ++n) w[n] = static_cast<long double>(q[n]) / std::sqrt(norm);
            return w;
        };
        Quad const expected = oracle_slerp(widened(a), widened(b), static_cast<long double>(t));
        long double same = 0;
        long double opposite = 0;
        for (std::size_t n = 0; n < 4; ++n) {
            long double const x = got[static_cast<math::axis_t>(n)];
            same = std::max(same, std::abs(x - expected[n]));
            opposite = std::max(opposite, std::abs(x + expected[n]));
        }
        CHECK(static_cast<double>(std::min(same, opposite)) < 1e-14);
    });
}

TEST_CASE("moving scenes come back equal when written", "[scene][motion][write]") {
    TemporaryFolder const folder;
    for_all(cases(25), integers(0, 1000000), [&](int seed) {
        scene::Scene s = moving();
        auto const number = [&](int k) { return std::sin(seed * 1.7 + k * 2.9) * std::pow(10.0, (seed + k) % 9 - 4); };
        s.nodes.push_back({"still", s.nodes.size() % 2 == 0 ? scene::none : 0U, {number(0), number(1), 0.0}, {0.1, number(2), 0.3, 1.0}, {1.0, number(3), 1.0}, std::nullopt});
        math::dmat4 matrix(1.0);
        matrix[3][0] = number(4);
        s.nodes.push_back({"", 3, {}, {0.0, 0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, matrix});
        scene::Instance more = s.instances[static_cast<std::size_t>(seed) % 2];
        more.node = static_cast<std::uint32_t>(seed) % 5;
        more.node_from_mesh[2][1] = number(5);
        more.weights.clear();
        s.instances.push_back(more);
        s.cameras[0].node = static_cast<std::uint32_t>(seed) % 5;
        s.lights[0].node_from_light[3][2] = number(6);
        s.animations[0].channels[0].times_s = {0.0F, static_cast<float>(seed), static_cast<float>(seed)};
        for (std::size_t k = 0; k < 9; ++k) s.animations[0].channels[0].values[k] = static_cast<float>(number(static_cast<int>(k)));
        scene::Primitive& p = s.meshes[0].primitives[0];
        if (seed % 3 == 0) {
            p.influences = 8;
            p.joints.assign(p.positions.size() * 8, 0);
            p.joint_weights.assign(p.positions.size() * 8, 0.125F);
            p.joints[5] = 1;
        }
        scene::settle(s);
        for (char const* const name : {"a.glb", "a.gltf"}) {
            auto const written = scene::write_gltf(s, folder / name);
            CAPTURE(written ? std::string() : written.failure().message);
            REQUIRE(written.has_value());
            auto const read = scene::load_gltf(folder / name);
            CAPTURE(read ? std::string() : read.failure().message);
            REQUIRE(read.has_value());
            CHECK(*read == s);
            CHECK(read->notes == scene::Notes{});
            CHECK(scene::flatten(*read, scene::pose_at(*read, {1.3, 0, true})).positions == scene::flatten(s, scene::pose_at(s, {1.3, 0, true})).positions);
        }
    });
}

TEST_CASE("a mask's texture coordinates reach its alpha turned, scaled and moved", "[scene][motion]") {
    std::string const json = replaced(triangle_json(), R"({"name":"paint"})",
        R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,3]}}}}})");
    scene::Scene const s = load(glb(replaced(json, R"("accessors")", R"("textures":[{}],"accessors")"), triangle_blob().bytes())).value();
    scene::Geometry const g = scene::flatten(s);
    // KHR_texture_transform: T R S, where a quarter turn takes (u, v) to (v, -u).
    for (std::size_t v = 0; v < 3; ++v) {
        math::vec2 const uv = s.meshes[0].primitives[0].uv0[v];
        CHECK(g.uv[v].x == Approx(0.25F + 3.0F * uv.y));
        CHECK(g.uv[v].y == Approx(0.5F - 2.0F * uv.x));
    }
}
