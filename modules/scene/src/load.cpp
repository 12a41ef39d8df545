#include <gnomon/scene/load.hpp>

#include "detail/gltf_parts.hpp"

#include <exception>
#include <filesystem>
#include <new>

namespace gnomon::scene {

namespace {

Scene load_document(std::span<std::byte const> bytes, std::string const& base_dir, LoadConfig const& config) {
    detail::Document document(bytes, base_dir, config);
    Scene scene;
    detail::load_materials(document, scene);
    std::vector<std::uint32_t> const mesh_of = detail::load_meshes(document, scene);
    detail::NodeMap const map = detail::load_nodes(document, mesh_of, scene);
    detail::load_skins(document, map, scene);
    detail::check_joints(scene);
    detail::load_animations(document, map, scene);
    scene.notes = std::move(document.notes);
    if (scene.instances.empty()) {
        std::string why = "the file has no triangles to draw";
        if (scene.notes.non_finite_triangles != 0)
            why += ": " + std::to_string(scene.notes.non_finite_triangles) + " with NaN or infinite corners were left out";
        else if (scene.notes.points_and_lines != 0)
            why += ": it holds points and lines only";
        detail::fail(SceneError::empty, why + "; give one with a mesh of triangles in its scene");
    }
    return scene;
}

SceneError code_of(detail::ReadError error) noexcept {
    switch (error) {
        case detail::ReadError::not_found: return SceneError::not_found;
        case detail::ReadError::too_large: return SceneError::over_limit;
        case detail::ReadError::not_a_file:
        case detail::ReadError::unreadable: break;
    }
    return SceneError::unreadable;
}

}  // namespace

Result<Scene> load_gltf_bytes(std::span<std::byte const> bytes, std::string const& base_dir, LoadConfig const& config) {
    try {
        return load_document(bytes, base_dir, config);
    } catch (detail::LoadFailure const& caught) {
        return caught.failure;
    } catch (std::bad_alloc const&) {
        return core::Failure{SceneError::over_limit, "the scene does not fit into memory; simplify it or lower the limits"};
    } catch (std::exception const& caught) {
        return core::Failure{SceneError::malformed, "the file is not valid glTF (" + std::string(caught.what()) + "); export it again"};
    }
}

Result<Scene> load_gltf(std::string const& path, LoadConfig const& config) {
    auto const named = [&](core::Failure<SceneError> failure) {
        failure.message = detail::quoted(path) + ": " + failure.message;
        return failure;
    };
    try {
        auto bytes = detail::read_file(path, config.limits.max_file_bytes);
        if (!bytes) return core::Failure{code_of(bytes.failure().code), detail::quoted(path) + " " + bytes.failure().message};
        std::string const folder = std::filesystem::path(path).parent_path().string();
        auto scene = load_gltf_bytes(*bytes, folder.empty() ? "." : folder, config);
        if (!scene) return named(std::move(scene).failure());
        return scene;
    } catch (std::exception const& caught) {
        return named({SceneError::unreadable, std::string("cannot be read (") + caught.what() + "); check the path"});
    }
}

}  // namespace gnomon::scene
