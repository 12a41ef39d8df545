#include <gnomon/scene/batches.hpp>

#include <gnomon/core/contract.hpp>

#include <cstddef>

namespace gnomon::scene {

namespace {

batch::Triangles triangles_of(GeometryBatches const& batches, Geometry const& geometry) {
    return {geometry.positions, geometry.indices, batches.group_of_triangle};
}

/// Ranges come draw by draw, and in each draw instance by instance.
void find_groups(Geometry const& geometry, GeometryBatches& out) {
    out.group_of_triangle.reserve(geometry.indices.size() / 3);
    std::uint32_t draw = 0;
    for (Range const& range : geometry.ranges) {
        if (range.triangle_count == 0) continue;
        while (range.first_triangle >= geometry.draws[draw].first_triangle + geometry.draws[draw].triangle_count) ++draw;
        BatchGroup const group{range.instance, draw};
        if (out.groups.empty() || out.groups.back() != group) out.groups.push_back(group);
        out.group_of_triangle.insert(out.group_of_triangle.end(), range.triangle_count,
                                     static_cast<std::uint32_t>(out.groups.size() - 1));
    }
}

}  // namespace

GeometryBatches make_batches(Geometry const& geometry, batch::Config const& config, core::ExecutorRef executor) {
    GeometryBatches out;
    find_groups(geometry, out);
    batch::Workspace workspace;
    batch::build_batches(triangles_of(out, geometry), config, workspace, out.batches, executor);
    out.indices.reserve(3 * out.batches.triangles.size());
    for (std::uint32_t const triangle : out.batches.triangles)
        for (std::size_t k = 0; k < 3; ++k) out.indices.push_back(geometry.indices[3 * std::size_t{triangle} + k]);
    return out;
}

GeometryBatches make_batches(Geometry const& geometry, batch::Config const& config) {
    core::SerialExecutor serial;
    return make_batches(geometry, config, serial);
}

std::uint64_t refit(GeometryBatches& batches, Geometry const& geometry, core::ExecutorRef executor) {
    GNOMON_EXPECT(batches.group_of_triangle.size() * 3 == geometry.indices.size());
    return batch::refit(batches.batches, triangles_of(batches, geometry), batches.batches.boxes, executor);
}

std::uint64_t refit(GeometryBatches& batches, Geometry const& geometry) {
    core::SerialExecutor serial;
    return refit(batches, geometry, serial);
}

}  // namespace gnomon::scene
