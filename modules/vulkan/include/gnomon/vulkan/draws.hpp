#pragma once
// Draw lists: the caller's draws, copied to the device once, and drawn with a number of calls that does not depend on
// how many draws, instances or triangles there are.

#include <gnomon/backend/draw.hpp>
#include <gnomon/core/strided_span.hpp>
#include <gnomon/vulkan/pass_pipelines.hpp>
#include <gnomon/vulkan/resources.hpp>
#include <gnomon/vulkan/ring.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::vulkan {

struct DrawListConfig {
    /// Array layers that one call draws; a pass of more has more calls. 20 bytes a draw each, or 40 where the draws are
    /// not sorted by culling and alpha test; and 64 bytes an instance.
    std::uint32_t max_layers = 8;
};

/// What a list left out when it was made. Ids of what stays are as if nothing had been left out.
struct StagedFaults {
    std::uint64_t bad_index_triangles = 0;   ///< With an index at or beyond the positions.
    std::uint64_t not_finite_triangles = 0;  ///< With a NaN or an infinity.
    std::uint32_t loose_indices = 0;         ///< 1 or 2 left over at the end of a draw.
    std::uint32_t broken_alpha_tests = 0;    ///< Without texture or coordinates: drawn solid.
};

/// Draws on the device. Move-only; must outlive what is recorded with it.
class DrawList {
  public:
    struct State;

    DrawList() noexcept;
    explicit DrawList(std::unique_ptr<State> state) noexcept;
    DrawList(DrawList&&) noexcept;
    DrawList& operator=(DrawList&&) noexcept;
    ~DrawList();

    /// Records the copy to the device; before anything is drawn, outside of a rendering.
    void record_upload(VkCommandBuffer commands);
    /// Frees the host-visible copy, once what `record_upload` recorded is done.
    void release_staging() noexcept;

    /// Of all instances.
    [[nodiscard]] std::uint64_t triangles() const noexcept;
    [[nodiscard]] StagedFaults const& faults() const noexcept;
    [[nodiscard]] VkDeviceSize size_bytes() const noexcept;

    [[nodiscard]] State& state() noexcept { return *state_; }
    [[nodiscard]] State const& state() const noexcept { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

/// Moves the positions of draw `draw`, its place in the span that the list was made of: writes them into `ring` and
/// records the copy from there. Draws that shared the span share the change.
///
/// Outside of a rendering; one barrier before the copy and one after it.
/// expects: as many positions as the draw had. The ring is flushed before the submit.
/// returns: how many are NaN or infinite: devices drop their triangles, as they drop what has no place, though no
///          specification says so. `bad_argument` for a draw that is not there, `too_large` when the ring is full; then
///          nothing was recorded.
[[nodiscard]] Result<std::uint64_t> record_update(VkCommandBuffer commands, DrawList& list, std::size_t draw,
                                                  core::StridedSpan<math::vec3> const& positions, HostRing& ring);

/// Copies draws into host-visible memory and makes all that drawing them takes.
///
/// Spans that several draws share (positions, coordinates, texels) are copied once. `Draw::origin` and
/// `Draw::clip_from_relative` are not read: views come with each pass.
/// returns: the list; or `too_large` where a limit of the device, which the message names, is passed.
/// cost:    O(bytes); two buffers on the device, one on the host until `release_staging`.
[[nodiscard]] Result<DrawList> make_draw_list(PassPipelinesRef const& pipelines, std::span<backend::Draw const> draws,
                                              DrawListConfig const& config = {});

}  // namespace gnomon::vulkan
