// Batches of a frame's geometry, and what becomes of them from frame to frame.

#include "casters.hpp"

#include <gnomon/batch/build.hpp>

#include <algorithm>

namespace gnomon::pipeline {

namespace {

/// The range of each triangle; ranges of instances that can move come after the others.
std::vector<std::uint32_t> ranges_of(Frame const& frame, std::vector<std::uint32_t>& order) {
    scene::Geometry const& g = *frame.geometry;
    order.clear();
    for (bool const posed : {false, true})
        for (std::uint32_t r = 0; r < g.ranges.size(); ++r)
            if (scene::is_posed(*frame.scene, frame.scene->instances[g.ranges[r].instance]) == posed) order.push_back(r);
    std::vector<std::uint32_t> range_of(g.indices.size() / 3);  // ranges cover all triangles
    for (std::uint32_t place = 0; place < order.size(); ++place) {
        scene::Range const& range = g.ranges[order[place]];
        std::fill_n(range_of.begin() + range.first_triangle, range.triangle_count, place);
    }
    return range_of;
}

}  // namespace

void Casters::build(Frame const& frame, core::ExecutorRef executor) {
    scene::Geometry const& g = *frame.geometry;
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> const range_of_triangle = ranges_of(frame, order);
    batches_ = {};
    batch::Workspace workspace;
    batch::build_batches({g.positions, g.indices, range_of_triangle}, {.max_triangles = config_.batch_triangles}, workspace, batches_, executor);
    // Batches are ordered by group, which is a range's place in `order`.
    instance_of_.clear();
    vertices_of_.clear();
    first_posed_ = size();
    for (std::size_t i = 0; i < size(); ++i) {
        scene::Range const& range = g.ranges[order[batches_.batches[i].group]];
        instance_of_.push_back(range.instance);
        vertices_of_.push_back({range.first_vertex, range.vertex_count});
        batches_.batches[i].group = order[batches_.batches[i].group];
        bool const posed = scene::is_posed(*frame.scene, frame.scene->instances[range.instance]);
        if (posed && first_posed_ == size()) first_posed_ = i;
    }
    indices_.clear();
    indices_.reserve(batches_.triangles.size() * 3);
    for (std::size_t i = 0; i < size(); ++i)
        for (std::uint32_t const t : triangles_of(i))
            for (std::size_t k = 0; k < 3; ++k) indices_.push_back(g.indices[std::size_t{t} * 3 + k] - vertices_of_[i].first);
    revisions_ = g.instance_revision;
    records_.assign(size(), {});
}

void Casters::add_alpha_test(Frame const& frame, scene::Material const& material, Vertices const& own) {
    scene::Texture const& texture = *base_texture(*frame.scene, material);
    scene::Image const& image = *base_image(*frame.scene, material);
    raster::AlphaTest test{std::span<math::vec2 const>(frame.geometry->uv).subspan(own.first, own.count), {image.rgba, image.size_px, texture.wrap_u, texture.wrap_v},
                           static_cast<double>(material.base_color.w), alpha_rule(*frame.scene, material).cutoff};
    auto const same = std::find_if(alpha_maps_.begin(), alpha_maps_.end(), [&](raster::AlphaMap const& map) { return map.is_of(test); });
    test.map = same != alpha_maps_.end() ? &*same : &alpha_maps_.emplace_back(raster::make_alpha_map(test));
    alpha_tests_.push_back(test);
}

void Casters::build_draws(Frame const& frame) {
    scene::Geometry const& g = *frame.geometry;
    resting_ = {};
    posed_ = {};
    alpha_tests_.clear();
    alpha_maps_.clear();
    alpha_tests_.reserve(size());  // pointed to
    for (std::size_t i = 0; i < size(); ++i) {
        batch::Batch const& batch = batches_.batches[i];
        scene::Material const& material = frame.scene->materials[g.ranges[batch.group].material];
        AlphaRule const rule = alpha_rule(*frame.scene, material);
        raster::Draw draw;
        draw.cull = material.double_sided ? raster::Cull::none : config_.cull;
        Vertices const& own = vertices_of_[i];
        if (!rule.nothing) {
            draw.positions = std::span<math::vec3 const>(g.positions).subspan(own.first, own.count);
            draw.indices = std::span<std::uint32_t const>(indices_).subspan(std::size_t{batch.first} * 3, std::size_t{batch.count} * 3);
        }
        if (rule.tested) {
            add_alpha_test(frame, material, own);
            draw.alpha_test = &alpha_tests_.back();
        }
        (i < first_posed_ ? resting_ : posed_).draws.push_back(draw);
    }
}

bool Casters::move_posed(Frame const& frame, std::uint64_t now) {
    scene::Geometry const& g = *frame.geometry;
    bool moved = false;
    for (std::size_t i = first_posed_; i < size(); ++i) {
        if (revisions_[instance_of_[i]] == g.instance_revision[instance_of_[i]]) continue;
        moved = true;
        math::Aabb box;
        std::size_t at = std::size_t{batches_.batches[i].first} * 3;
        for (std::uint32_t const t : triangles_of(i))
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t const from = g.indices[std::size_t{t} * 3 + k];
                indices_[at++] = from - vertices_of_[i].first;  // an instance that is mirrored now has its windings turned
                box = math::extended(box, g.positions[from]);
            }
        batches_.boxes[i] = box;
        records_[i] = cache::advance(records_[i], cache::ObjectEvent::moved, now);
    }
    revisions_ = g.instance_revision;
    return moved;
}

void Casters::keep(Verbs& verbs, bool all) {
    if (all) resting_.kept = Held(verbs.device(), verbs(verbs.device().keep(resting_.draws)));
    posed_.kept = {};
    posed_.kept = Held(verbs.device(), verbs(verbs.device().keep(posed_.draws)));
}

bool Casters::follow(Verbs& verbs, Frame const& frame, CasterConfig const& config, std::uint64_t now, core::ExecutorRef executor) {
    scene::Geometry const& g = *frame.geometry;
    bool const other = geometry_ != &g || identity_ != g.identity || config.batch_triangles != config_.batch_triangles;
    bool const turned = config.cull != config_.cull;
    config_ = config;
    bool moved = false;
    if (other) {
        identity_ = nullptr;
        build(frame, executor);
        for (std::size_t i = 0; i < size(); ++i) {
            // What is not there at all stays absent: it is neither planned nor counted.
            if (alpha_rule(*frame.scene, frame.scene->materials[g.ranges[batches_.batches[i].group].material]).nothing) continue;
            records_[i].mobility = i < first_posed_ ? cache::Mobility::fixed : cache::Mobility::automatic;
            records_[i] = cache::advance(records_[i], cache::ObjectEvent::appeared, now);
        }
    } else {
        moved = move_posed(frame, now);
    }
    if (other || turned) build_draws(frame);
    redrawn_ = other || turned || moved;
    if (config.keeps_lists && redrawn_) keep(verbs, other || turned);
    for (cache::ObjectRecord& record : records_) record = cache::settle(record, config.rest, now);
    if (!verbs.good()) return true;
    geometry_ = &g;
    identity_ = g.identity;
    return other;
}

}  // namespace gnomon::pipeline
