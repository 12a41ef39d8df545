#pragma once
// Unique clusters: which keys there are among the samples of an image, ascending, and each sample's place among them.
//
// Three methods, one result. Samples come as blocks of runs of equal keys: neighbours mostly share a cluster, and each
// method then works on runs. Where they do not, a run is a sample: nothing depends on coherence but time.
//
// source: [Olsson 2014, Paper II, 3.2, 3.4, 4.2, 4.3]

#include <gnomon/cluster/detail/serial.hpp>
#include <gnomon/cluster/key.hpp>
#include <gnomon/cluster/unique_workspace.hpp>
#include <gnomon/core/executor.hpp>

#include <cstdint>
#include <span>

namespace gnomon::cluster {

/// Whether the methods with a table can take a layout: their memory is a few bits for each key there could be, and numbers of keys have 32 bits.
template <Key K>
[[nodiscard]] constexpr bool fits_table(KeyLayout<K> const& layout) noexcept {
    return layout.domain() < 0xFFFFFFFFULL;
}

/// Sets a bit for each key, ranks them by counting bits, and reads each run's rank back.
///
/// expects: `fits_table(layout)`; `out.index` as large as `keys`; fewer than 2^32 - 1 samples
/// returns: the needed number of keys, see `UniqueStats`
/// cost:    O(samples + domain / 16384); 2 bits for each key there could be
template <Key K, core::Executor E = core::SerialExecutor const>
UniqueStats unique_by_bitmap(KeyLayout<K> const& layout, std::span<K const> keys, UniqueOut<K> const& out,
                             UniqueWorkspace<K>& work, E& executor = detail::serial);

/// Flags the pages of keys, numbers the flagged ones by a prefix sum, flags keys in those, and compacts them.
///
/// expects: as `unique_by_bitmap`
/// cost:    O(samples + domain / 64 + 64 pages); half a bit for each key there could be, 256 bytes a page with a key
/// source:  [Olsson 2014, Paper II, 3.2, 4.3]
template <Key K, core::Executor E = core::SerialExecutor const>
UniqueStats unique_by_page_table(KeyLayout<K> const& layout, std::span<K const> keys, UniqueOut<K> const& out,
                                 UniqueWorkspace<K>& work, E& executor = detail::serial);

/// Compacts and sorts the runs of each block of samples, merges the blocks' lists, and links runs to the result.
///
/// expects: as `unique_by_bitmap`, but for the layout, which may be any
/// cost:    O(samples + keys of all blocks log(them)), for keys that a multiplication spreads; independent of the domain
/// source:  [Olsson 2014, Paper II, 3.2, 4.2]; a tile is a block of consecutive samples here, of any
///          image, and is compacted by a hash table before it is sorted
template <Key K, core::Executor E = core::SerialExecutor const>
UniqueStats unique_by_local_sort(KeyLayout<K> const& layout, std::span<K const> keys, UniqueOut<K> const& out,
                                 UniqueWorkspace<K>& work, E& executor = detail::serial);

}  // namespace gnomon::cluster

#include <gnomon/cluster/detail/unique_bitmap.hpp>
#include <gnomon/cluster/detail/unique_pages.hpp>
#include <gnomon/cluster/detail/unique_sort.hpp>
