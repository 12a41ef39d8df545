#pragma once
// The rule of batches, written naively: all pairs, each time.

#include <gnomon/batch/batches.hpp>
#include <gnomon/math/morton.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace naive {

using gnomon::math::Aabb;

struct Cluster {
    Aabb box;
    std::size_t rank = 0;                  ///< The lowest place of its triangles on the curve.
    std::vector<std::uint32_t> triangles;
};

inline double distance(Cluster const& a, Cluster const& b) {
    double sum = 0.0;
    for (gnomon::math::axis_t axis = 0; axis < 3; ++axis) {
        float const hi = std::max(a.box.hi[axis], b.box.hi[axis]);
        float const lo = std::min(a.box.lo[axis], b.box.lo[axis]);
        float const extent = hi * 0.5F - lo * 0.5F;
        sum += static_cast<double>(extent) * static_cast<double>(extent);
    }
    return sum;
}

/// The box of the curve: 14 of 16 parts of the centres along each axis, and four times the largest extent of those more.
inline Aabb curve_box(std::vector<gnomon::math::vec3> const& centers) {
    Aabb all;
    for (gnomon::math::vec3 const& c : centers) all = gnomon::math::extended(all, c);
    std::size_t const count = std::min<std::size_t>(centers.size(), 1024);
    if (count == 0) return all;
    float extent = 0.0F;
    Aabb most;
    for (gnomon::math::axis_t axis = 0; axis < 3; ++axis) {
        std::vector<float> sorted;
        for (std::size_t i = 0; i < count; ++i) sorted.push_back(centers[i * centers.size() / count][axis]);
        std::sort(sorted.begin(), sorted.end());
        most.lo[axis] = sorted[count / 16];
        most.hi[axis] = sorted[count - 1 - count / 16];
        extent = std::max(extent, most.hi[axis] - most.lo[axis]);
    }
    for (gnomon::math::axis_t axis = 0; axis < 3 && extent > 0.0F; ++axis) {
        all.lo[axis] = std::max(all.lo[axis], most.lo[axis] - 4.0F * extent);
        all.hi[axis] = std::min(all.hi[axis], most.hi[axis] + 4.0F * extent);
    }
    return all;
}

/// The usable triangles of each group, in the order of their places on the curve.
inline std::map<std::uint32_t, std::vector<Cluster>> leaves(gnomon::batch::Triangles const& list) {
    struct Leaf {
        std::uint32_t triangle;
        Aabb box;
    };
    std::vector<Leaf> kept;
    std::vector<gnomon::math::vec3> centers;
    for (std::uint32_t t = 0; t < list.size(); ++t) {
        Aabb box;
        bool good = true;
        for (std::size_t k = 0; k < 3 && good; ++k) {
            std::uint32_t const i = list.indices[3 * t + k];
            good = i < list.positions.size() && gnomon::math::is_finite(list.positions[i]);
            if (good) box = gnomon::math::extended(box, list.positions[i]);
        }
        if (!good) continue;
        kept.push_back({t, box});
        centers.push_back(gnomon::math::center(box));
    }
    Aabb const curve = curve_box(centers);
    std::stable_sort(kept.begin(), kept.end(), [&](Leaf const& a, Leaf const& b) {
        return gnomon::math::morton_63(curve, gnomon::math::center(a.box)) <
               gnomon::math::morton_63(curve, gnomon::math::center(b.box));
    });
    std::map<std::uint32_t, std::vector<Cluster>> groups;
    for (Leaf const& leaf : kept) {
        auto& group = groups[list.group(leaf.triangle)];
        group.push_back({leaf.box, group.size(), {leaf.triangle}});
    }
    return groups;
}

/// The batches of one group: subtrees of at most `max` triangles whose parents are larger, in no order.
inline std::vector<std::vector<std::uint32_t>> agglomerate(std::vector<Cluster> clusters, std::size_t max) {
    std::vector<std::vector<std::uint32_t>> batches;
    auto const emit = [&](Cluster const& c) {
        if (c.triangles.size() <= max) batches.push_back(c.triangles);
    };
    while (clusters.size() > 1) {
        std::tuple<double, std::size_t, std::size_t> best{};
        std::size_t first = clusters.size();
        std::size_t second = 0;
        for (std::size_t i = 0; i < clusters.size(); ++i)
            for (std::size_t j = i + 1; j < clusters.size(); ++j) {
                std::tuple const key(distance(clusters[i], clusters[j]), std::min(clusters[i].rank, clusters[j].rank),
                                     std::max(clusters[i].rank, clusters[j].rank));
                if (first != clusters.size() && !(key < best)) continue;
                best = key;
                first = i;
                second = j;
            }
        Cluster& a = clusters[first];
        Cluster const b = clusters[second];
        if (a.triangles.size() + b.triangles.size() > max) {
            emit(a);
            emit(b);
        }
        a.box = gnomon::math::merged(a.box, b.box);
        a.rank = std::min(a.rank, b.rank);
        a.triangles.insert(a.triangles.end(), b.triangles.begin(), b.triangles.end());
        clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(second));
    }
    for (Cluster const& c : clusters) emit(c);
    return batches;
}

/// Sorted sets of sorted triangles.
inline std::vector<std::vector<std::uint32_t>> batches(gnomon::batch::Triangles const& list, std::size_t max) {
    std::vector<std::vector<std::uint32_t>> all;
    for (auto const& [group, clusters] : leaves(list))
        for (auto& one : agglomerate(clusters, max)) {
            std::sort(one.begin(), one.end());
            all.push_back(one);
        }
    std::sort(all.begin(), all.end());
    return all;
}

/// The same of built batches.
inline std::vector<std::vector<std::uint32_t>> batches_of(gnomon::batch::Batches const& built) {
    std::vector<std::vector<std::uint32_t>> all;
    for (gnomon::batch::Batch const& b : built.batches) {
        auto const first = built.triangles.begin() + static_cast<std::ptrdiff_t>(b.first);
        all.emplace_back(first, first + static_cast<std::ptrdiff_t>(b.count));
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace naive
