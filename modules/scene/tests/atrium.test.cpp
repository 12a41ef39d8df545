#include "mesh_facts.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/path.hpp>

#include "../src/detail/atrium_lights.hpp"
#include "../src/detail/coarse_grid.hpp"
#include "../src/detail/pcg32.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

scene::ProceduralConfig atrium_with(std::string lights, bool trees = false) {
    scene::ProceduralConfig config{"atrium"};
    config.lights = std::move(lights);
    config.trees = trees;
    return config;
}

scene::Scene atrium(std::string lights, bool trees = false) {
    auto result = scene::make_procedural(atrium_with(std::move(lights), trees));
    REQUIRE(result.has_value());
    return std::move(result).value();
}

bool in_hall(math::dvec3 const& p) { return std::abs(p.x) <= 20.0 && p.y >= 0.0 && p.y <= 20.0 && std::abs(p.z) <= 12.5; }

}  // namespace

TEST_CASE("the atrium has the light sets that are fixed for it", "[scene][atrium]") {
    CHECK(atrium("").lights == atrium("sun").lights);
    CHECK(atrium("sun").lights.at(0).kind == scene::LightKind::directional);
    scene::Scene const s = atrium("sponza65");
    REQUIRE(s.lights.size() == 65);
    std::set<std::array<double, 3>> places;
    for (scene::Light const& l : s.lights) {
        CHECK(l.kind == scene::LightKind::point);
        CHECK(l.range_m == 6.0F);
        CHECK(in_hall(l.position_m));
        places.insert({l.position_m.x, l.position_m.y, l.position_m.z});
    }
    CHECK(places.size() == 65);
    CHECK(atrium("65").lights == s.lights);
    CHECK_FALSE(scene::make_procedural(atrium_with("torches")).has_value());
    CHECK_FALSE(scene::make_procedural(atrium_with("0")).has_value());
    CHECK_FALSE(scene::make_procedural(atrium_with("1048577")).has_value());
    scene::ProceduralConfig city{"city"};
    city.trees = true;
    CHECK_FALSE(scene::make_procedural(city).has_value());
}

TEST_CASE("none of the 65 lights is inside something", "[scene][atrium]") {
    scene::Scene const s = atrium("sponza65");
    scene::Geometry const g = scene::flatten(s);
    scene::detail::CoarseGrid const grid(g);
    for (scene::Light const& l : s.lights) {
        std::size_t backs = 0;
        for (int k = 0; k < 27; ++k) {
            math::dvec3 const d(k % 3 - 1 + 0.013, k / 3 % 3 - 1 + 0.017, k / 9 - 1 + 0.011);
            scene::detail::GridHit const hit = grid.cast(l.position_m - g.origin_m, d);
            backs += hit.triangle != scene::none && !hit.front ? 1U : 0U;
        }
        CAPTURE(l.name);
        CHECK(backs == 0);
    }
}

TEST_CASE("any number of lights is drawn uniformly in the hall from seed 1", "[scene][atrium]") {
    scene::Scene const s = atrium("10000");
    REQUIRE(s.lights.size() == 10'000);
    math::dvec3 sum(0.0);
    std::size_t outside = 0;
    for (scene::Light const& l : s.lights) {
        sum += l.position_m;
        outside += in_hall(l.position_m) && l.range_m == 2.5F ? 0U : 1U;
    }
    CHECK(outside == 0);
    CHECK(glm::length(sum / 10'000.0 - math::dvec3(0.0, 10.0, 0.0)) < 0.5);  // six standard deviations
    scene::detail::Pcg32 random(1);
    double const x = random.uniform(-20.0, 20.0);
    double const y = random.uniform(0.0, 20.0);
    CHECK(s.lights[0].position_m == math::dvec3(x, y, random.uniform(-12.5, 12.5)));
    scene::Scene const few = atrium("100");
    for (std::size_t i = 0; i < 100; ++i) CHECK(few.lights[i].position_m == s.lights[i].position_m);
}

TEST_CASE("twelve bare trees of 8,000 triangles stand in the atrium if asked for", "[scene][atrium]") {
    scene::Scene const s = atrium("", true);
    std::size_t trees = 0;
    for (scene::Instance const& i : s.instances) {
        if (i.name != "tree" && i.name != "tub") continue;
        test::EdgeFacts const facts = test::edge_facts(s, s.meshes[i.mesh]);
        CHECK(facts.closed == facts.edges);
        CHECK(facts.degenerate == 0);
        if (i.name == "tub") continue;
        ++trees;
        std::size_t triangles = 0;
        for (scene::Primitive const& p : s.meshes[i.mesh].primitives) triangles += p.indices.size() / 3;
        CHECK(triangles == 7'990);
        CHECK(in_hall(math::dvec3(i.world_from_mesh[3])));
    }
    CHECK(trees == 12);
}

namespace {

/// The clusters of [Olsson 2014, Paper II, section 3.1]: tiles of 32x32 px of a picture of 1920x1080, and slices as deep as
/// their tiles are high: k = floor(ln(z / near) / ln(1 + 2 tan(fov / 2) / S_y)), S_y = 1080 / 32.
struct Clusters {
    double slope = 0.57735026918962576;  ///< tan(30 degrees): half the height of the picture one metre away.
    double near_m = 0.1;
    double ratio = 1.0 + 2.0 * 0.57735026918962576 / (1080.0 / 32.0);

    int slice(double z) const { return static_cast<int>(std::floor(std::log(z / near_m) / std::log(ratio))); }

    /// The box round the cluster's piece of the frustum; x right, y down, z away.
    std::array<math::dvec3, 2> box(std::array<int, 3> const& key) const {
        std::array<math::dvec3, 2> b{math::dvec3(1e300), math::dvec3(-1e300)};
        for (int corner = 0; corner < 8; ++corner) {
            double const z = near_m * std::pow(ratio, key[2] + corner / 4);
            double const x = (32.0 * (key[0] + corner % 2) - 960.0) / 540.0 * slope * z;
            double const y = (std::min(32.0 * (key[1] + corner / 2 % 2), 1080.0) - 540.0) / 540.0 * slope * z;
            b[0] = glm::min(b[0], math::dvec3(x, y, z));
            b[1] = glm::max(b[1], math::dvec3(x, y, z));
        }
        return b;
    }
};

/// The clusters that a ray through the middle of every `step`th pixel of the view `still` ends in.
std::set<std::array<int, 3>> occupied_clusters(scene::Scene const& s, int step) {
    scene::Geometry const g = scene::flatten(s);
    scene::detail::CoarseGrid const grid(g);
    scene::Camera const& c = s.cameras.at(0);
    Clusters const clusters;
    std::set<std::array<int, 3>> keys;
    for (int y = 0; y < 1080; y += step)
        for (int x = 0; x < 1920; x += step) {
            math::dvec3 const d = c.right * ((x + 0.5 - 960.0) / 540.0 * clusters.slope) -
                                  c.up * ((y + 0.5 - 540.0) / 540.0 * clusters.slope) - c.back;
            scene::detail::GridHit const hit = grid.cast(c.eye_m - g.origin_m, d);
            if (hit.triangle != scene::none && hit.distance > clusters.near_m)
                keys.insert({x / 32, y / 32, clusters.slice(hit.distance)});
        }
    return keys;
}

struct Load {
    double mean = 0.0;
    std::size_t max = 0;
};

/// Lights whose sphere touches a cluster's box, by a grid of 0.5 m over the lights in view space.
Load count_load(scene::Scene const& s, std::set<std::array<int, 3>> const& keys, double radius_m) {
    constexpr double cell_m = 0.5;
    scene::Camera const& c = s.cameras.at(0);
    auto const cell_of = [](double v) { return static_cast<int>(std::floor(v / cell_m)) + 128; };
    std::vector<std::vector<math::dvec3>> grid(std::size_t{256} * 256 * 256);
    auto const at = [&](int x, int y, int z) -> std::vector<math::dvec3>& {
        return grid[(static_cast<std::size_t>(z) * 256 + static_cast<std::size_t>(y)) * 256 + static_cast<std::size_t>(x)];
    };
    for (scene::Light const& l : s.lights) {
        math::dvec3 const d = l.position_m - c.eye_m;
        math::dvec3 const v(glm::dot(d, c.right), -glm::dot(d, c.up), -glm::dot(d, c.back));
        at(cell_of(v.x), cell_of(v.y), cell_of(v.z)).push_back(v);
    }
    Load load;
    std::size_t sum = 0;
    for (auto const& key : keys) {
        auto const [lo, hi] = Clusters{}.box(key);
        std::size_t count = 0;
        for (int z = cell_of(lo.z - radius_m); z <= cell_of(hi.z + radius_m); ++z)
            for (int y = cell_of(lo.y - radius_m); y <= cell_of(hi.y + radius_m); ++y)
                for (int x = cell_of(lo.x - radius_m); x <= cell_of(hi.x + radius_m); ++x)
                    for (math::dvec3 const& p : at(x, y, z)) {
                        math::dvec3 const away = p - glm::clamp(p, lo, hi);
                        count += glm::dot(away, away) <= radius_m * radius_m ? 1U : 0U;
                    }
        sum += count;
        load.max = std::max(load.max, count);
    }
    load.mean = static_cast<double>(sum) / static_cast<double>(keys.size());
    return load;
}

}  // namespace

TEST_CASE("an occupied cluster of the view `still` meets 45 of the million lights on average", "[.full][scene][atrium]") {
    scene::Scene const s = atrium("million");
    REQUIRE(s.lights.size() == 1'048'576);
    auto const keys = occupied_clusters(s, 2);
    double const radius_m = static_cast<double>(s.lights[0].range_m);
    Load const load = count_load(s, keys, radius_m);
    CAPTURE(keys.size(), radius_m, load.mean, load.max);
    CHECK(keys.size() > 7'000);
    CHECK(std::abs(load.mean - 45.0) < 0.1);
    CHECK(load.max > 250);
    CHECK(load.max < 310);
}
