#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/procedural.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

using namespace gnomon;

namespace {

scene::Scene made(scene::ProceduralConfig const& config) {
    auto result = scene::make_procedural(config);
    REQUIRE(result.has_value());
    return std::move(result).value();
}

std::uint64_t triangles_of(std::string const& name, std::uint64_t budget, std::uint32_t blocks = 1) {
    return scene::count_triangles(made({name, budget, blocks, 0.0, 0}));
}

std::uint64_t fnv(std::uint64_t hash, void const* data, std::size_t size) {
    auto const* bytes = static_cast<unsigned char const*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211U;
    return hash;
}

std::uint64_t hash_of(scene::Geometry const& g) {
    std::uint64_t hash = 14695981039346656037U;
    hash = fnv(hash, g.positions.data(), g.positions.size() * sizeof(g.positions[0]));
    hash = fnv(hash, g.normals.data(), g.normals.size() * sizeof(g.normals[0]));
    return fnv(hash, g.indices.data(), g.indices.size() * sizeof(g.indices[0]));
}

/// How often each edge, as a pair of positions, is used one way and the other.
std::map<std::array<float, 6>, std::array<int, 2>> edge_uses(scene::Geometry const& g) {
    std::map<std::array<float, 6>, std::array<int, 2>> uses;
    auto const key = [&](std::uint32_t a, std::uint32_t b) {
        math::vec3 const p = g.positions[a];
        math::vec3 const q = g.positions[b];
        return std::array<float, 6>{p.x, p.y, p.z, q.x, q.y, q.z};
    };
    for (std::size_t i = 0; i < g.indices.size(); i += 3)
        for (std::size_t e = 0; e < 3; ++e) {
            auto const forward = key(g.indices[i + e], g.indices[i + (e + 1) % 3]);
            auto const backward = key(g.indices[i + (e + 1) % 3], g.indices[i + e]);
            if (forward < backward)
                ++uses[forward][0];
            else
                ++uses[backward][1];
        }
    return uses;
}

}  // namespace

TEST_CASE("the procedural scenes come in the sizes that are fixed for them", "[scene][procedural]") {
    CHECK(triangles_of("city", 0) == 254'048);
    CHECK(triangles_of("city", 52'000) == 52'448);
    CHECK(triangles_of("city", 1'010'000) == 1'010'048);
    CHECK(triangles_of("city", 254'000, 40) == 10'161'920);
    CHECK(triangles_of("rayyard", 0) == 274'432);
    CHECK(triangles_of("rayyard", 59'000) == 59'392);
    CHECK(triangles_of("rayyard", 1'040'000) == 1'042'432);
    CHECK(triangles_of("cubes", 0) == 12'000);
    CHECK(triangles_of("sheet", 0) == 130'050);
}

TEST_CASE("every procedural scene is valid, has a light, a view and a description", "[scene][procedural]") {
    for (scene::ProceduralInfo const& info : scene::procedural_scenes()) {
        CAPTURE(std::string(info.name));
        scene::Scene const s = made({std::string(info.name), 0, 1, 0.0, 0});
        CHECK(scene::validate(s).has_value());
        CHECK(!s.lights.empty());
        CHECK(!s.cameras.empty());
        CHECK(info.description.find('\n') == std::string_view::npos);
        CHECK(scene::is_procedural(info.name));
    }
    CHECK_FALSE(scene::is_procedural("atlantis"));
}

TEST_CASE("an object is at most about 500 triangles, but for the sheet", "[scene][procedural]") {
    for (std::string const name : {"city", "rayyard", "cubes"}) {
        scene::Geometry const g = scene::flatten(made({name, name == "city" ? 1'010'000U : 0U, 1, 0.0, 0}));
        for (scene::Range const& range : g.ranges) CHECK(range.triangle_count <= 512);
    }
}

TEST_CASE("the same floats come out of the procedural scenes everywhere", "[scene][procedural]") {
    CHECK(hash_of(scene::flatten(made({"city", 52'000, 1, 0.0, 0}))) == 15395701812836638616U);
    CHECK(hash_of(scene::flatten(made({"rayyard", 59'000, 1, 0.0, 0}))) == 5921773871120081643U);
    CHECK(hash_of(scene::flatten(made({"cubes", 0, 1, 0.0, 0}))) == 18425730034437788991U);
    CHECK(hash_of(scene::flatten(made({"sheet", 0, 1, 0.0, 0}))) == 12871955299792722615U);
}

TEST_CASE("another seed gives another city of the same size", "[scene][procedural]") {
    scene::Scene const a = made({"city", 52'000, 1, 0.0, 0});
    scene::Scene const b = made({"city", 52'000, 1, 0.0, 7});
    CHECK(scene::count_triangles(a) == scene::count_triangles(b));
    CHECK_FALSE(a == b);
    CHECK(a == made({"city", 52'000, 1, 0.0, 12345}));
}

TEST_CASE("more blocks surround the city and leave its middle as it is", "[scene][procedural]") {
    scene::Scene const one = made({"city", 52'000, 1, 0.0, 0});
    scene::Scene const nine = made({"city", 52'000, 9, 0.0, 0});
    REQUIRE(nine.instances.size() == 9 * one.instances.size());
    CHECK(std::equal(one.instances.begin(), one.instances.end(), nine.instances.begin()));
    scene::Geometry const g = scene::flatten(nine);
    CHECK(g.bounds.lo.x == -1500.0F);
    CHECK(g.bounds.hi.z == 1500.0F);
}

TEST_CASE("the street view of the city stands outside all buildings", "[scene][procedural]") {
    scene::Scene const city = made({"city", 52'000, 1, 0.0, 0});
    for (scene::Camera const& camera : city.cameras)
        for (scene::Instance const& i : city.instances) {
            if (i.name != "building") continue;
            math::dmat4 const& m = i.world_from_mesh;
            bool const inside = std::abs(camera.eye_m.x - m[3][0]) < m[0][0] * 0.5 + 1.0 &&
                                std::abs(camera.eye_m.z - m[3][2]) < m[2][2] * 0.5 + 1.0 && camera.eye_m.y < m[1][1] + 1.0;
            CHECK_FALSE(inside);
        }
}

TEST_CASE("cubes are closed: every edge is used once each way", "[scene][procedural]") {
    scene::Geometry const g = scene::flatten(made({"cubes", 0, 1, 0.0, 0}));
    std::size_t bad = 0;
    for (auto const& [edge, uses] : edge_uses(g)) bad += uses == std::array<int, 2>{1, 1} ? 0U : 1U;
    CHECK(bad == 0);
}

TEST_CASE("the faces of a building meet without T-junctions", "[scene][procedural]") {
    for (std::uint64_t const budget : {52'000U, 254'000U, 1'010'000U}) {
        scene::Scene city = made({"city", budget, 1, 0.0, 0});
        city.instances.erase(city.instances.begin(), city.instances.begin() + 4);  // the ground
        city.instances.resize(40);
        std::size_t bad = 0;
        for (auto const& [edge, uses] : edge_uses(scene::flatten(city))) {
            bool const on_ground = edge[1] == 0.0F && edge[4] == 0.0F;
            bad += on_ground || uses == std::array<int, 2>{1, 1} ? 0U : 1U;
        }
        CHECK(bad == 0);
    }
}

TEST_CASE("the sheet's points and edge middles are floats at each offset", "[scene][procedural]") {
    for (double const offset : {0.0, 8192.0, 131072.0}) {
        scene::Scene const s = made({"sheet", 0, 1, offset, 0});
        scene::Geometry const g = scene::flatten(s, {math::dvec3(0.0)});
        scene::Primitive const& p = s.meshes[0].primitives[0];
        std::size_t bad = 0;
        for (std::size_t i = 0; i < p.positions.size(); ++i)
            bad += math::to_double(g.positions[i]) == math::to_double(p.positions[i]) + math::dvec3(offset) ? 0U : 1U;
        for (std::size_t i = 0; i < p.indices.size(); i += 3) {
            math::dvec3 const middle =
                (math::to_double(g.positions[p.indices[i]]) + math::to_double(g.positions[p.indices[i + 1]])) * 0.5;
            bad += math::to_double(math::to_float(middle)) == middle ? 0U : 1U;
        }
        CHECK(bad == 0);
        CHECK(scene::flatten(s).origin_m == math::dvec3(offset));
    }
}

TEST_CASE("a wrong configuration is refused with the value and what to do", "[scene][procedural]") {
    auto const refuses = [](scene::ProceduralConfig const& config, char const* says) {
        auto const result = scene::make_procedural(config);
        REQUIRE_FALSE(result.has_value());
        CHECK(result.failure().code == scene::SceneError::bad_config);
        CAPTURE(result.failure().message);
        CHECK(result.failure().message.find(says) != std::string::npos);
    };
    refuses({"atlantis", 0, 1, 0.0, 0}, "atlantis");
    refuses({"city", 10, 1, 0.0, 0}, "10");
    refuses({"city", 99'000'000'000U, 1, 0.0, 0}, "99000000000");
    refuses({"city", 0, 0, 0.0, 0}, "0 blocks");
    refuses({"city", 0, 4000, 0.0, 0}, "4000");
    refuses({"cubes", 7, 1, 0.0, 0}, "7");
    refuses({"cubes", 0, 2, 0.0, 0}, "2");
    refuses({"sheet", 0, 1, 0.1, 0}, "0.1");
    refuses({"sheet", 0, 1, std::nan(""), 0}, "nan");
    CHECK_FALSE(scene::make_procedural({"rayyard", 1, 1, 0.0, 0}).has_value());
    CHECK_FALSE(scene::make_procedural({"rayyard", ~std::uint64_t{0}, 1, 0.0, 0}).has_value());
}
