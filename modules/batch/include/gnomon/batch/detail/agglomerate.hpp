#pragma once
// Bottom-up agglomeration of one group: always the two clusters whose common box has the shortest diagonal become one.
//
// The dissimilarity never falls when a cluster grows, so a pair of clusters that are each other's nearest stays so until
// it is merged: such pairs may be merged in any order, and the tree is that of always merging the nearest pair of all.
// A chain of nearest neighbours finds them. Ties are broken by a total order, (distance, lower slot, higher slot), where a
// cluster's slot is its lowest leaf; the order does not fall on merging either, so the tree is unique.
//
// source:  F. Murtagh, "A survey of recent advances in hierarchical clustering algorithms", 1983 (chains)
//          [Walter 2008] = Walter, Bala, Kulkarni, Pingali: "Fast agglomerative clustering for rendering" (monotony)

#include <gnomon/batch/detail/box_tree.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace gnomon::batch::detail {

/// The arrays of one group, one entry per slot but for the blocks.
struct GroupArrays {
    std::span<Block> blocks;
    std::span<std::uint32_t> size;   ///< Triangles of the cluster in the slot; 0: none.
    std::span<std::uint32_t> owner;  ///< A slot of the same batch, lower or the same; followed to its end, the batch.
    std::span<std::uint32_t> chain;
};

struct Limits {
    std::uint32_t max_triangles;
    std::uint32_t max_visits;
};

class Agglomeration {
public:
    Agglomeration(GroupArrays const& arrays, Limits const& limits) noexcept
        : arrays_(arrays), limits_(limits), tree_(arrays.blocks, arrays.size.size()), left_(arrays.size.size()) {}

    /// Merges until no cluster of up to `max_triangles` can grow; returns the searches that gave up.
    std::uint64_t run() noexcept {
        for (std::uint32_t slot = 0; slot < arrays_.size.size(); ++slot)
            while (left_ > 1 && arrays_.size[slot] != 0 && arrays_.size[slot] <= limits_.max_triangles) follow(slot);
        return hurried_;
    }

private:
    /// From `slot` to its nearest, to the nearest of that one, and so on; merges pairs that are each other's nearest.
    void follow(std::uint32_t slot) noexcept {
        std::span<std::uint32_t> const chain = arrays_.chain;
        std::size_t length = 0;
        chain[length++] = slot;
        while (length != 0 && left_ > 1) {
            std::uint32_t const top = chain[length - 1];
            Nearest before;
            if (length > 1) {
                before.slot = chain[length - 2];
                before.distance = diagonal_sq(math::merged(tree_.box(top), tree_.box(before.slot)));
            }
            std::uint32_t visits = 0;
            Nearest const found = tree_.nearest(top, before, limits_.max_visits, visits);
            if (visits >= limits_.max_visits) {  // `found` may stand in the chain already, which then leads nowhere
                ++hurried_;
                merge(top, found.slot);
                return;
            }
            if (length > 1 && found.slot == before.slot) {
                merge(top, before.slot);
                length -= 2;
            } else {
                chain[length++] = found.slot;
            }
        }
    }

    void merge(std::uint32_t a, std::uint32_t b) noexcept {
        if (b < a) std::swap(a, b);
        math::Aabb const box = math::merged(tree_.box(a), tree_.box(b));
        tree_.remove(b);
        tree_.grow(a, box);
        std::uint32_t const size = arrays_.size[a] + arrays_.size[b];
        // A subtree that is too large keeps both parts as they are: each is a batch, or a union of batches.
        if (size <= limits_.max_triangles) arrays_.owner[b] = a;
        arrays_.size[a] = size;
        arrays_.size[b] = 0;
        --left_;
    }

    GroupArrays arrays_;
    Limits limits_;
    BoxTree tree_;
    std::size_t left_;
    std::uint64_t hurried_ = 0;
};

}  // namespace gnomon::batch::detail
