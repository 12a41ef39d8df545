// Skins, morph targets and clips that lie: a sentence, or a count in the notes.
#include "motion_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/pose.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace gnomon;
using namespace fixture;

namespace {

using scene::SceneError;

void refuses_motion(std::string const& from, std::string const& to, SceneError code, std::string const& says) {
    auto const result = load(moving_data().file(replaced(moving_json(), from, to)));
    CAPTURE(from);
    CAPTURE(to);
    REQUIRE_FALSE(result.has_value());
    CAPTURE(result.failure().message);
    CHECK(result.failure().code == code);
    CHECK(result.failure().message.find(says) != std::string::npos);
    CHECK(result.failure().message.find(';') != std::string::npos);
}

void refuses_motion(std::string const& from, std::string const& to, std::string const& says) {
    refuses_motion(from, to, SceneError::malformed, says);
}

scene::Scene mended(std::string const& from, std::string const& to) {
    auto result = load(moving_data().file(replaced(moving_json(), from, to)));
    CAPTURE(result ? std::string() : result.failure().message);
    REQUIRE(result.has_value());
    REQUIRE(scene::validate(*result).has_value());
    scene::Geometry const g = scene::flatten(*result, scene::pose_at(*result, {1.2, scene::all_clips, true}));
    for (std::uint32_t const index : g.indices) CHECK(math::is_finite(g.positions[index]));
    return std::move(result).value();
}

/// A mesh of one triangle with joints and weights as given, on a skin of two joints.
scene::Result<scene::Scene> skinned(Blob const& joints, int joint_type, Blob const& weights, int weight_type, bool normalized) {
    FileMaker f;
    f.accessor(Blob().add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F), 5126, "VEC3", 3);
    f.accessor(joints, joint_type, "VEC4", 3);
    f.accessor(weights, weight_type, "VEC4", 3, normalized ? R"(,"normalized":true)" : "");
    return load(f.file(R"("nodes":[{"mesh":0,"skin":0},{},{}],"skins":[{"joints":[1,2]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])"));
}

template <class T>
Blob rows_of(std::vector<T> const& row) {
    Blob b;
    for (int v = 0; v < 3; ++v)
        for (T const x : row) b.add(x);
    return b;
}

}  // namespace

TEST_CASE("indices of skins, joints, samplers, nodes and accessors out of range are named", "[scene][hostile]") {
    refuses_motion(R"("skin":0)", R"("skin":1)", "skin 1");
    refuses_motion(R"("joints":[1,2])", R"("joints":[1,7])", "node 7");
    refuses_motion(R"("joints":[1,2])", R"("joints":[])", "no joints");
    refuses_motion(R"("joints":[1,2])", R"("joints":[1])", "joint 1");
    refuses_motion(R"("joints":[1,2])", R"("joints":[1,2,3])", "inverse bind");
    refuses_motion(R"("inverseBindMatrices":4)", R"("inverseBindMatrices":0)", "inverse bind");
    refuses_motion(R"("inverseBindMatrices":4)", R"("inverseBindMatrices":99)", "accessor 99");
    refuses_motion(R"("JOINTS_0":2)", R"("JOINTS_0":3,"x":0)", "joint 255");  // the weights taken for joints
    refuses_motion(R"("JOINTS_0":2)", R"("JOINTS_0":11)", "JOINTS_0");
    refuses_motion(R"("JOINTS_0":2,)", "", "without");
    refuses_motion(R"("WEIGHTS_0":3)", R"("WEIGHTS_0":0)", "WEIGHTS_0 of 3");
    refuses_motion(R"({"POSITION":6})", R"({"POSITION":1})", "POSITION of 1");
    refuses_motion(R"({"POSITION":6})", R"({"POSITION":-1})", "'POSITION' is -1");
    refuses_motion(R"({"POSITION":6})", R"({"POSITION":77})", "accessor 77");
    refuses_motion(R"("sampler":0)", R"("sampler":4)", "sampler 4");
    refuses_motion(R"("node":1)", R"("node":7)", "node 7");
    refuses_motion(R"("input":7)", R"("input":0)", "key times");
    refuses_motion(R"("input":7)", R"("input":1)", "key times");
    refuses_motion(R"("output":8)", R"("output":9)", "4 components");
    refuses_motion(R"("output":8)", R"("output":0)", "3 keys and 4 values");
    refuses_motion(R"("output":10)", R"("output":7)", "2 wanted for each");
    refuses_motion(R"("output":9,"interpolation":"CUBICSPLINE")", R"("output":11,"interpolation":"CUBICSPLINE")", "3 wanted for each");
}

TEST_CASE("primitives of one mesh with unequal morph targets are named", "[scene][hostile]") {
    refuses_motion(R"("targets":[{"POSITION":5},{"POSITION":6}]}])", R"("targets":[{"POSITION":5},{"POSITION":6}]},{"attributes":{"POSITION":0}}])", "morph targets");
}

TEST_CASE("channels that move nothing here are left out and counted", "[scene][hostile]") {
    CHECK(mended(R"("path":"weights")", R"("path":"pointer")").notes.dropped_channels == 1);
    CHECK(mended(R"("interpolation":"STEP")", R"("interpolation":"BEZIER")").notes.dropped_channels == 1);
    CHECK(mended(R"("node":3,"path":"weights")", R"("node":1,"path":"weights")").notes.dropped_channels == 1);
    CHECK(mended(R"("node":1,"path":"translation")", R"("path":"translation")").notes.dropped_channels == 1);
    CHECK(mended(R"({"name":"root",)", R"({"name":"root","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1],)").notes.dropped_channels == 1);
}

TEST_CASE("key times that fall, or are NaN or negative, and values that are not finite cost the channel", "[scene][hostile]") {
    float const nan = std::nanf("");
    for (auto const& times : std::vector<std::vector<float>>{{0.0F, 2.0F, 1.0F}, {0.0F, nan, 1.0F}, {-1.0F, 0.0F, 1.0F}, {0.0F, 1.0F, std::numeric_limits<float>::infinity()}}) {
        FileMaker f = moving_data();
        f.accessor(Blob().add(times[0], times[1], times[2]), 5126, "SCALAR", 3);
        auto const s = load(f.file(replaced(moving_json(), R"("input":7)", R"("input":12)")));
        REQUIRE(s.has_value());
        CHECK(s->notes.dropped_channels == 1);
        CHECK(s->animations[0].channels.size() == 3);
    }
    FileMaker f = moving_data();
    f.accessor(Blob().add(0.0F, 0.0F, 0.0F, 0.0F, nan, 0.0F, 4.0F, 2.0F, 0.0F), 5126, "VEC3", 3);
    auto const s = load(f.file(replaced(moving_json(), R"("output":8)", R"("output":12)")));
    REQUIRE(s.has_value());
    CHECK(s->notes.dropped_channels == 1);
}

TEST_CASE("two keys at one time are a step", "[scene][motion]") {
    FileMaker f = moving_data();
    f.accessor(Blob().add(0.0F, 1.0F, 1.0F), 5126, "SCALAR", 3);
    auto const s = load(f.file(replaced(moving_json(), R"("input":7)", R"("input":12)")));
    REQUIRE(s.has_value());
    CHECK(scene::pose_at(*s, {0.5, 0, false}).parent_from_node[0].translation == math::dvec3(0.0, 1.0, 0.0));
    CHECK(scene::pose_at(*s, {1.0, 0, false}).parent_from_node[0].translation == math::dvec3(4.0, 2.0, 0.0));
}

TEST_CASE("morph offsets that are not finite become 0 and are counted", "[scene][hostile]") {
    FileMaker f = moving_data();
    float const inf = std::numeric_limits<float>::infinity();
    f.accessor(Blob().add(0.0F, 0.0F, inf, 0.0F, 0.0F, 2.0F, std::nanf(""), 0.0F, 3.0F, 0.0F, 0.0F, 4.0F), 5126, "VEC3", 4);
    auto const s = load(f.file(replaced(moving_json(), R"({"POSITION":5})", R"({"POSITION":12})")));
    REQUIRE(s.has_value());
    CHECK(s->notes.mended_offsets == 2);
    CHECK(scene::validate(*s).has_value());
}

TEST_CASE("inverse bind matrices that are not finite are named", "[scene][hostile]") {
    FileMaker f = moving_data();
    Blob bind;
    for (int k = 0; k < 32; ++k) bind.add(k == 20 ? std::nanf("") : 1.0F);
    f.accessor(bind, 5126, "MAT4", 2);
    auto const s = load(f.file(replaced(moving_json(), R"("inverseBindMatrices":4)", R"("inverseBindMatrices":12)")));
    REQUIRE_FALSE(s.has_value());
    CHECK(s.failure().message.find("matrix 1") != std::string::npos);
}

TEST_CASE("joints and weights of each type are read; those that do not sum to 1 are scaled and counted", "[scene][motion]") {
    using u8 = std::uint8_t;
    using u16 = std::uint16_t;
    auto const joints8 = rows_of<u8>({1, 0, 0, 0});
    auto const check = [](scene::Result<scene::Scene> const& s, float w0, float w1, std::uint64_t mended_count) {
        CAPTURE(s ? std::string() : s.failure().message);
        REQUIRE(s.has_value());
        scene::Primitive const& p = s->meshes[0].primitives[0];
        CHECK(p.joint_weights[0] == Approx(w0));
        CHECK(p.joint_weights[1] == Approx(w1));
        CHECK(p.joints[0] == (w0 == 0.0F ? 0 : 1));
        CHECK(s->notes.mended_weights == mended_count);
        CHECK(scene::validate(*s).has_value());
    };
    float const nan = std::nanf("");
    check(skinned(joints8, 5121, rows_of<u8>({51, 204, 0, 0}), 5121, true), 0.2F, 0.8F, 0);
    check(skinned(rows_of<u16>({1, 0, 0, 0}), 5123, rows_of<u16>({13107, 52428, 0, 0}), 5123, true), 0.2F, 0.8F, 0);
    check(skinned(joints8, 5121, rows_of<float>({0.25F, 0.75F, 0.0F, 0.0F}), 5126, false), 0.25F, 0.75F, 0);
    check(skinned(joints8, 5121, rows_of<float>({1.0F, 3.0F, 0.0F, 0.0F}), 5126, false), 0.25F, 0.75F, 3);
    check(skinned(joints8, 5121, rows_of<u8>({1, 3, 0, 0}), 5121, false), 0.25F, 0.75F, 3);
    check(skinned(joints8, 5121, rows_of<float>({0.0F, 0.0F, 0.0F, 0.0F}), 5126, false), 1.0F, 0.0F, 3);
    check(skinned(joints8, 5121, rows_of<float>({nan, 1.0F, -5.0F, 0.0F}), 5126, false), 0.0F, 1.0F, 3);
    check(skinned(joints8, 5121, rows_of<float>({3e38F, 3e38F, 3e38F, 0.0F}), 5126, false), 1.0F / 3.0F, 1.0F / 3.0F, 3);
    check(skinned(joints8, 5121, rows_of<float>({1.0F, std::numeric_limits<float>::infinity(), 0.0F, 0.0F}), 5126, false), 1.0F, 0.0F, 3);
    CHECK_FALSE(skinned(rows_of<float>({1.0F, 0.0F, 0.0F, 0.0F}), 5126, rows_of<u8>({51, 204, 0, 0}), 5121, true).has_value());
    CHECK_FALSE(skinned(rows_of<std::uint32_t>({70000, 0, 0, 0}), 5125, rows_of<u8>({51, 204, 0, 0}), 5121, true).has_value());
    CHECK(skinned(rows_of<std::uint32_t>({1, 70000, 0, 0}), 5125, rows_of<u8>({255, 0, 0, 0}), 5121, true).has_value());
}

TEST_CASE("clips, skins and targets are counted against a limit before they are read", "[scene][hostile]") {
    scene::LoadConfig config;
    for (std::uint64_t limit = 0; limit < 200; limit += 20) {
        config.limits.max_motion_values = limit;
        auto const refused = load(moving_file(), config);
        CAPTURE(limit);
        if (limit >= 140) {
            CHECK(refused.has_value());
        } else {
            REQUIRE_FALSE(refused.has_value());
            CHECK(refused.failure().code == SceneError::over_limit);
            CHECK(refused.failure().message.find("max_motion_values") != std::string::npos);
        }
    }
    // A thousand channels that all name the same keys: small in the file, large in memory.
    std::string many;
    for (int i = 0; i < 1000; ++i) many += target(0, 1, "translation") + ",";
    config.limits.max_motion_values = 10'000;
    auto const shared = load(moving_data().file(replaced(moving_json(), R"("channels":[)", R"("channels":[)" + many)), config);
    REQUIRE_FALSE(shared.has_value());
    CHECK(shared.failure().code == SceneError::over_limit);
}

TEST_CASE("any changed byte of a moving file gives a scene or a sentence", "[scene][hostile]") {
    std::vector<std::byte> const good = moving_file();
    std::size_t scenes = 0;
    std::uint32_t noise = 4711;
    for (std::size_t at = 0; at < good.size(); ++at) {
        noise = noise * 1664525U + 1013904223U;
        std::vector<std::byte> bytes = good;
        bytes[at] ^= static_cast<std::byte>(1U + (noise >> 24U) % 255U);
        auto const result = load(bytes);
        if (!result) {
            CHECK(result.failure().message.size() > 10);
            continue;
        }
        ++scenes;
        CHECK(scene::validate(*result).has_value());
        scene::Geometry const g = scene::flatten(*result, scene::pose_at(*result, {1.2, scene::all_clips, true}));
        for (std::uint32_t const index : g.indices) CHECK(math::is_finite(g.positions[index]));
    }
    CHECK(scenes > good.size() / 8);
}
