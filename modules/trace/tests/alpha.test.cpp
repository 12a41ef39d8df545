#include <gnomon/check/check.hpp>

#include <gnomon/trace/alpha.hpp>
#include <gnomon/trace/build.hpp>

#include "../../math/tests/texels.hpp"
#include "scenes.hpp"

#include <array>
#include <cstdint>

using namespace gnomon;
using math::Wrap;
using texels::Texels;
using trace::AlphaMaterial;

TEST_CASE("solid is alpha at the cutoff or above; unmasked is solid", "[trace][alpha]") {
    Texels const texels(51, 51, 51, 51);
    std::array const textures{texels.texture(Wrap::repeat)};
    math::dvec2 const uv(0.5, 0.5);
    CHECK(trace::is_solid({false, 1.0F, 0.9F, 0}, textures, uv));
    CHECK(trace::is_solid({true, 1.0F, 0.2F - 1e-7F, 0}, textures, uv));
    CHECK_FALSE(trace::is_solid({true, 1.0F, 0.2F + 1e-7F, 0}, textures, uv));
    CHECK(trace::is_solid({true, 0.5F, 0.5F, AlphaMaterial::no_texture}, textures, uv));
    CHECK_FALSE(trace::is_solid({true, 0.4999F, 0.5F, 77}, textures, uv));
}

TEST_CASE("a masked triangle casts the shadow of its solid half", "[trace][alpha]") {
    scenes::Mesh mesh;
    mesh.add(math::vec3(0.0F, 1.0F, 0.0F), math::vec3(8.0F, 1.0F, 0.0F), math::vec3(0.0F, 1.0F, 8.0F));
    trace::Bvh const bvh = trace::build_bvh(mesh.list());
    Texels const texels(0, 255, 0, 255);
    std::array const textures{texels.texture(Wrap::clamp)};
    std::array const materials{AlphaMaterial{true, 1.0F, 0.5F, 0}};
    std::array const material_of{std::uint32_t{0}};
    std::array const uvs{math::vec2(0.0F, 0.0F), math::vec2(2.0F, 0.0F), math::vec2(0.0F, 2.0F)};
    trace::AlphaTest const test{material_of, materials, textures, uvs};
    auto const up = trace::Light::direction(math::vec3(0.0F, 1.0F, 0.0F));
    CHECK_FALSE(is_blocked(bvh, {math::vec3(1.9F, 0.0F, 1.0F), up}, {}, test));  // u = 0.475
    CHECK(is_blocked(bvh, {math::vec3(2.0F, 0.0F, 1.0F), up}, {}, test));        // u = 0.5: exactly the cutoff
    CHECK(is_blocked(bvh, {math::vec3(3.0F, 0.0F, 1.0F), up}, {}, test));
    CHECK(is_blocked(bvh, {math::vec3(1.9F, 0.0F, 1.0F), up}));
}
