// `scenes`: the built-in scenes as a table, or one of them as a glTF file.

#include "verbs.hpp"

#include "find_by_name.hpp"
#include "inputs.hpp"
#include "output.hpp"
#include "table.hpp"
#include "values.hpp"

#include <gnomon/mesh/half_edges.hpp>
#include <gnomon/scene/batches.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/write.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace gnomon::command {

namespace {

std::string list_of_scenes() {
    std::vector<std::vector<std::string>> rows;
    std::string descriptions;
    rows.push_back({"scene", "options", "paths", "light sets", "triangles"});
    for (scene::ProceduralInfo const& info : scene::procedural_scenes()) {
        std::vector<std::string> options;
        if (info.takes_triangles) options.emplace_back("--triangles");
        if (info.takes_blocks) options.emplace_back("--blocks");
        if (info.takes_offset) options.emplace_back("--offset");
        if (info.max_moving_percent > 0.0) options.emplace_back("--moving");
        if (info.takes_trees) options.emplace_back("--trees");
        if (info.max_lights > 0) options.emplace_back("--lights N");
        rows.push_back({std::string(info.name), join(options, " "), join(names_of(info.paths), " "),
                        join(names_of(info.light_sets), " "), grouped(info.default_triangles)});
        descriptions += fmt::format("{}: {}\n", info.name, info.description);
    }
    return aligned(rows, {.left = 4}) + '\n' + descriptions +
           "\nAny .gltf or .glb file is a scene too. `gnomon scenes NAME` says more about one of either kind.\n";
}

std::string names_and_count(auto const& things) {
    constexpr std::size_t shown = 12;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(things.size(), shown); ++i)
        names.push_back(things[i].name.empty() ? "(no name)" : things[i].name);
    if (things.size() > shown) names.emplace_back("...");
    return things.empty() ? "none" : fmt::format("{}: {}", things.size(), join(names));
}

/// How closed the surface is, corners welded by place, and what it comes to in batches.
std::string facts_about_triangles(scene::Scene const& scene) {
    scene::Geometry const geometry = scene::flatten(scene);
    mesh::MeshReport const report = mesh::build_half_edges({geometry.positions, geometry.indices}).report;
    auto const percent = [&](std::uint64_t edges) {
        return 100.0 * static_cast<double>(edges) / static_cast<double>(std::max<std::uint64_t>(report.edges(), 1));
    };
    std::string text = fmt::format("edges   {}: {:.1f} % closed, {:.1f} % open, {:.1f} % flipped, {:.1f} % of three triangles or more\n",
                                   grouped(report.edges()), percent(report.manifold_edges), percent(report.open_edges),
                                   percent(report.flipped_edges), percent(report.non_manifold_edges));
    if (report.duplicate_triangles + report.degenerate_triangles != 0)
        text += fmt::format("        but for {} duplicate and {} degenerate triangles\n", grouped(report.duplicate_triangles),
                            grouped(report.degenerate_triangles));
    batch::Config const config;
    scene::GeometryBatches const made = scene::make_batches(geometry, config);
    return text + fmt::format("batches {} of up to {} triangles, in {} instances and draws\n",
                              grouped(made.batches.batches.size()), config.max_triangles, grouped(made.groups.size()));
}

std::string facts_about(LoadedScene const& loaded) {
    scene::Scene const& scene = loaded.scene;
    std::vector<std::vector<std::string>> const numbers = {
        {"triangles drawn", grouped(scene::count_triangles(scene))},
        {"triangles stored", grouped(scene::count_unique_triangles(scene))},
        {"meshes", grouped(scene.meshes.size())},
        {"instances", grouped(scene.instances.size())},
        {"materials", grouped(scene.materials.size())},
        {"images", grouped(scene.images.size())},
        {"animations", grouped(scene.animations.size())},
        {"skins", grouped(scene.skins.size())}};
    std::string text = fmt::format("{}\n\n{}\nviews   {}\nlights  {}\nclips   {}\n", loaded.text, aligned(numbers),
                                   names_and_count(scene.cameras), names_and_count(scene.lights),
                                   names_and_count(scene.animations));
    text += facts_about_triangles(scene);
    for (std::string const& warning : scene.notes.warnings) text += "note    " + warning + '\n';
    return text;
}

}  // namespace

Outcome<core::Done> list_or_write_scenes(ScenesOptions const& options) {
    if (!options.scene) return print(list_of_scenes());
    if (options.write) {
        if (!options.write->ends_with(".glb") && !options.write->ends_with(".gltf"))
            return usage_error(fmt::format("--write {}: give a name that ends in .glb or .gltf", *options.write));
        if (auto file = check_file("--write", *options.write); !file) return file;
    }
    auto loaded = load_scene(*options.scene);
    if (!loaded) return std::move(loaded).failure();
    if (!options.write) return print(facts_about(*loaded));
    auto written = scene::write_gltf(loaded->scene, *options.write);
    if (!written) return failure(written.failure().message);
    return print(fmt::format("{}: {} triangles written to {}\n", loaded->text,
                             grouped(scene::count_triangles(loaded->scene)), *options.write));
}

}  // namespace gnomon::command
