#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/pose.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::check;

namespace {

/// A triangle on a node that hangs on another, a camera and a light on the outer one.
scene::Scene on_nodes() {
    scene::Scene s;
    s.materials.resize(1);
    scene::Primitive p;
    p.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    p.normals.assign(3, math::vec3(0.0F, 0.0F, 1.0F));
    p.indices = {0, 1, 2};
    p.material = 0;
    s.meshes.resize(1);
    s.meshes[0].primitives = {p};
    s.nodes.resize(2);
    s.nodes[0].translation = {10.0, 0.0, 0.0};
    s.nodes[1].parent = 0;
    s.nodes[1].scale = {2.0, 2.0, 2.0};
    s.instances.resize(2);
    s.instances[0].mesh = 0;
    s.instances[1].mesh = 0;
    s.instances[1].node = 1;
    s.instances[1].node_from_mesh[3] = math::dvec4(0.5, 0.0, 0.0, 1.0);
    s.cameras.resize(1);
    s.cameras[0].node = 0;
    s.lights.resize(1);
    s.lights[0].node = 0;
    scene::settle(s);
    return s;
}

scene::AnimationChannel channel(std::uint32_t node, scene::AnimationPath path, std::vector<float> times_s, std::vector<float> values) {
    scene::AnimationChannel c;
    c.node = node;
    c.path = path;
    c.times_s = std::move(times_s);
    c.values = std::move(values);
    return c;
}

bool close(math::dvec3 const& a, math::dvec3 const& b) { return glm::length(a - b) < 1e-9; }

}  // namespace

TEST_CASE("at rest, nodes multiply out and settle puts things where they carry them", "[scene][pose]") {
    scene::Scene const s = on_nodes();
    CHECK(scene::validate(s).has_value());
    CHECK(s.instances[1].world_from_mesh[3] == math::dvec4(11.0, 0.0, 0.0, 1.0));
    CHECK(s.instances[1].world_from_mesh[0][0] == 2.0);
    CHECK(s.cameras[0].eye_m == math::dvec3(10.0, 0.0, 0.0));
    CHECK(s.lights[0].position_m == math::dvec3(10.0, 0.0, 0.0));
    scene::Pose const pose = scene::rest_pose(s);
    CHECK(pose.world_from_mesh[1] == s.instances[1].world_from_mesh);
    CHECK(pose == scene::pose_at(s, {1.0, 0, true}));  // no clips: any time is rest
    scene::Geometry const g = scene::flatten(s);
    CHECK(g.positions[4] == math::vec3(13.0F, 0.0F, 0.0F));
}

TEST_CASE("a clip moves nodes and all that they carry, and what stands alone stays", "[scene][pose]") {
    scene::Scene s = on_nodes();
    float const half = std::sqrt(0.5F);
    s.animations.resize(1);
    s.animations[0].channels = {
        channel(0, scene::AnimationPath::translation, {0.0F, 2.0F}, {10.0F, 0.0F, 0.0F, 20.0F, 4.0F, 0.0F}),
        channel(0, scene::AnimationPath::rotation, {0.0F, 2.0F}, {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, half, half})};
    REQUIRE(scene::validate(s).has_value());
    CHECK(scene::duration_s(s.animations[0]) == 2.0);
    scene::Pose const middle = scene::pose_at(s, {1.0, 0, true});
    double const diagonal = std::sqrt(0.5);
    // Half of a quarter turn about z, at (15, 2, 0); the mesh stands 1 m out on the turned x axis.
    CHECK(close(middle.cameras[0].eye_m, {15.0, 2.0, 0.0}));
    CHECK(close(middle.cameras[0].right, {diagonal, diagonal, 0.0}));
    CHECK(close(middle.lights[0].position_m, {15.0, 2.0, 0.0}));
    CHECK(close(math::dvec3(middle.world_from_mesh[1][3].x, middle.world_from_mesh[1][3].y, 0.0), {15.0 + diagonal, 2.0 + diagonal, 0.0}));
    CHECK(middle.world_from_mesh[0] == math::dmat4(1.0));
    CHECK(close(scene::posed_camera(s, middle, 0).eye_m, {15.0, 2.0, 0.0}));
    CHECK(close(scene::posed_light(s, middle, 0).position_m, {15.0, 2.0, 0.0}));
    CHECK(scene::pose_at(s, {3.0, 0, true}) == middle);
    CHECK(scene::pose_at(s, {-1.0, 0, true}) == middle);
    CHECK(scene::pose_at(s, {2.0, 0, true}) == scene::pose_at(s, {0.0, 0, true}));
    CHECK(close(scene::pose_at(s, {7.0, 0, false}).cameras[0].eye_m, {20.0, 4.0, 0.0}));
    CHECK(close(scene::pose_at(s, {-7.0, 0, false}).cameras[0].eye_m, {10.0, 0.0, 0.0}));
    CHECK(scene::pose_at(s, {std::nan(""), 0, true}) == scene::pose_at(s, {0.0, 0, true}));
    CHECK(scene::pose_at(s, {1.0, scene::none, true}).world_from_mesh == scene::rest_pose(s).world_from_mesh);
}

TEST_CASE("updating a geometry in place gives what flattening anew gives", "[scene][pose]") {
    scene::Scene s = on_nodes();
    s.animations.resize(1);
    s.animations[0].channels = {channel(1, scene::AnimationPath::scale, {0.0F, 1.0F}, {1.0F, 1.0F, 1.0F, -3.0F, 2.0F, 1.0F})};
    scene::Geometry moved = scene::flatten(s);
    scene::Pose pose;
    for (double const t : {0.0, 0.1, 0.9, 0.5, 0.2}) {
        scene::pose_at(s, {t, 0, true}, pose);
        scene::update(moved, s, pose);
        scene::Geometry const anew = scene::flatten(s, pose);
        CHECK(moved.positions == anew.positions);
        CHECK(moved.normals == anew.normals);
        CHECK(moved.indices == anew.indices);
        CHECK(moved.ranges == anew.ranges);
        CHECK(moved.bounds == anew.bounds);
        CHECK(moved.instance_bounds == anew.instance_bounds);
        CHECK(moved.origin_m == anew.origin_m);
    }
}
