#include <gnomon/scene/scene.hpp>

#include "detail/validate_motion.hpp"

#include <gnomon/math/scalar.hpp>

#include <cmath>
#include <cstddef>

namespace gnomon::scene {

namespace {

using core::Done;
using core::Failure;

Failure<SceneError> broken(std::string message) { return {SceneError::malformed, std::move(message)}; }

std::string nth(char const* what, std::size_t i) { return std::string(what) + " " + std::to_string(i); }

template <class T>
bool all_finite(std::vector<T> const& values) {
    for (T const& v : values)
        for (int i = 0; i < T::length(); ++i)
            if (!math::is_finite(v[i])) return false;
    return true;
}

bool is_finite_matrix(math::dmat4 const& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!math::is_finite(m[column][row])) return false;
    return true;
}

Result<Done> validate_primitive(Scene const& scene, Primitive const& p, std::string const& where) {
    std::size_t const n = p.positions.size();
    if (p.normals.size() != n)
        return broken(where + " has " + std::to_string(n) + " positions and " + std::to_string(p.normals.size()) +
                      " normals; give one normal per position");
    if ((!p.uv0.empty() && p.uv0.size() != n) || (!p.uv1.empty() && p.uv1.size() != n))
        return broken(where + " has " + std::to_string(n) + " positions and " + std::to_string(p.uv0.size()) + " and " +
                      std::to_string(p.uv1.size()) + " texture coordinates; give one per position or none");
    if (p.indices.size() % 3 != 0)
        return broken(where + " has " + std::to_string(p.indices.size()) + " indices; give three per triangle");
    for (std::uint32_t index : p.indices)
        if (index >= n)
            return broken(where + " has index " + std::to_string(index) + " and only " + std::to_string(n) +
                          " positions; give an index below that");
    if (p.material >= scene.materials.size())
        return broken(where + " names material " + std::to_string(p.material) + " of " +
                      std::to_string(scene.materials.size()) + "; give one that exists");
    if (!all_finite(p.positions) || !all_finite(p.normals) || !all_finite(p.uv0) || !all_finite(p.uv1))
        return broken(where + " holds a NaN or an infinity; leave that vertex out");
    return Done{};
}

Result<Done> validate_materials(Scene const& scene) {
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        Image const& image = scene.images[i];
        bool const sane = image.size_px.x > 0 && image.size_px.y > 0;
        if (!sane || image.rgba.size() / 4 / static_cast<std::size_t>(image.size_px.x) !=
                         static_cast<std::size_t>(image.size_px.y) ||
            image.rgba.size() % (4 * static_cast<std::size_t>(image.size_px.x)) != 0)
            return broken(nth("image", i) + " is " + std::to_string(image.size_px.x) + "x" +
                          std::to_string(image.size_px.y) + " pixels and holds " + std::to_string(image.rgba.size()) +
                          " bytes; give four per pixel");
    }
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
        if (scene.textures[i].image >= scene.images.size())
            return broken(nth("texture", i) + " names image " + std::to_string(scene.textures[i].image) + " of " +
                          std::to_string(scene.images.size()) + "; give one that exists");
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material const& m = scene.materials[i];
        TextureUse const& use = m.base_color_texture;
        double sum = static_cast<double>(m.metallic) + static_cast<double>(m.roughness) + static_cast<double>(m.alpha_cutoff) +
                     static_cast<double>(use.offset.x) + static_cast<double>(use.offset.y) + static_cast<double>(use.scale.x) +
                     static_cast<double>(use.scale.y) + static_cast<double>(use.rotation_rad);
        for (int c = 0; c < 3; ++c) sum += static_cast<double>(m.base_color[c]) + static_cast<double>(m.emissive[c]);
        if (!math::is_finite(sum + static_cast<double>(m.base_color.w)))
            return broken(nth("material", i) + " has a NaN or an infinity; give finite numbers");
        if (use.texture != none && use.texture >= scene.textures.size())
            return broken(nth("material", i) + " names texture " + std::to_string(use.texture) + " of " +
                          std::to_string(scene.textures.size()) + "; give one that exists, or none");
        if (use.uv_set > 1)
            return broken(nth("material", i) + " uses texture coordinate set " + std::to_string(use.uv_set) +
                          "; sets 0 and 1 are kept");
    }
    return Done{};
}

Result<Done> validate_instances(Scene const& scene) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        Instance const& instance = scene.instances[i];
        if (instance.mesh >= scene.meshes.size())
            return broken(nth("instance", i) + " names mesh " + std::to_string(instance.mesh) + " of " +
                          std::to_string(scene.meshes.size()) + "; give one that exists");
        if (!is_finite_matrix(instance.world_from_mesh))
            return broken(nth("instance", i) + " has a NaN or an infinity in its matrix; give finite numbers");
    }
    return Done{};
}

bool is_unit(math::dvec3 const& v) noexcept { return std::abs(glm::dot(v, v) - 1.0) < 1e-3; }

Result<Done> validate_cameras(Scene const& scene) {
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        Camera const& c = scene.cameras[i];
        if (!math::is_finite(c.eye_m) || !is_unit(c.right) || !is_unit(c.up) || !is_unit(c.back))
            return broken(nth("camera", i) + " has no finite position and axes of length 1; give it some");
        bool const perspective = c.kind == CameraKind::perspective;
        bool const opens = perspective ? c.fov_y_rad > 0.0 && c.fov_y_rad < 3.14159265358979323846 && c.near_m > 0.0
                                       : c.half_width_m > 0.0 && c.half_height_m > 0.0 && math::is_finite(c.far_m) &&
                                             math::is_finite(c.half_width_m) && math::is_finite(c.half_height_m);
        if (!opens || !math::is_finite(c.near_m) || !(c.near_m < c.far_m))
            return broken(nth("camera", i) + " has near " + std::to_string(c.near_m) + " m, far " +
                          std::to_string(c.far_m) + " m, or a field that is not open; give near < far and a field above 0");
    }
    return Done{};
}

Result<Done> validate_lights(Scene const& scene) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        Light const& l = scene.lights[i];
        if (!math::is_finite(l.position_m) || !is_unit(l.direction))
            return broken(nth("light", i) + " has no finite position and direction of length 1; give it some");
        bool const shines = math::is_finite(l.color) && math::is_finite(l.intensity) && l.intensity >= 0.0F && l.range_m > 0.0F;
        bool const opens = l.inner_cone_rad >= 0.0F && l.inner_cone_rad <= l.outer_cone_rad && l.outer_cone_rad < 1.58F;
        if (!shines || !opens)
            return broken(nth("light", i) + " has intensity " + std::to_string(l.intensity) + ", range " +
                          std::to_string(l.range_m) + " m and cones " + std::to_string(l.inner_cone_rad) + " and " +
                          std::to_string(l.outer_cone_rad) + " rad; give intensity >= 0, range > 0, inner <= outer <= pi/2");
    }
    return Done{};
}

}  // namespace

std::uint32_t count_morph_targets(Mesh const& mesh) noexcept {
    return mesh.primitives.empty() ? 0 : static_cast<std::uint32_t>(mesh.primitives.front().morph_targets.size());
}

bool is_posed(Scene const& scene, Instance const& instance) noexcept {
    return instance.node != none || instance.skin != none || count_morph_targets(scene.meshes[instance.mesh]) != 0;
}

std::uint64_t count_triangles(Scene const& scene) noexcept {
    std::uint64_t count = 0;
    for (Instance const& instance : scene.instances)
        if (instance.mesh < scene.meshes.size())
            for (Primitive const& p : scene.meshes[instance.mesh].primitives) count += p.indices.size() / 3;
    return count;
}

std::uint64_t count_unique_triangles(Scene const& scene) noexcept {
    std::uint64_t count = 0;
    for (Mesh const& mesh : scene.meshes)
        for (Primitive const& p : mesh.primitives) count += p.indices.size() / 3;
    return count;
}

Result<Done> validate(Scene const& scene) {
    if (auto ok = validate_materials(scene); !ok) return ok;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (std::size_t p = 0; p < scene.meshes[m].primitives.size(); ++p)
            if (auto ok = validate_primitive(scene, scene.meshes[m].primitives[p],
                                             nth("mesh", m) + ", " + nth("primitive", p));
                !ok)
                return ok;
    if (auto ok = validate_instances(scene); !ok) return ok;
    if (auto ok = validate_cameras(scene); !ok) return ok;
    if (auto ok = validate_lights(scene); !ok) return ok;
    return detail::validate_motion(scene);
}

Camera looking_at(std::string name, math::dvec3 const& eye_m, math::dvec3 const& target_m, double fov_y_rad) {
    GNOMON_EXPECT(math::is_finite(eye_m) && math::is_finite(target_m) && eye_m != target_m);
    Camera camera;
    camera.name = std::move(name);
    camera.eye_m = eye_m;
    camera.back = glm::normalize(eye_m - target_m);
    // Straight up or down has no upright; any level axis will do then.
    bool const upright = std::abs(camera.back.x) + std::abs(camera.back.z) > 1e-9;
    camera.right = upright ? glm::normalize(math::dvec3(camera.back.z, 0.0, -camera.back.x)) : math::dvec3(1.0, 0.0, 0.0);
    camera.up = glm::cross(camera.back, camera.right);
    camera.fov_y_rad = fov_y_rad;
    return camera;
}

}  // namespace gnomon::scene
