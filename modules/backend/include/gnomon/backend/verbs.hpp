#pragma once
// The verbs that every technique is written in once, for any backend.
//
// Verbs are recorded and take effect in the order they are called, as if each ended before the next began. Only
// `finish` waits. What a verb is given (spans, configurations) may change once it has returned, unless it says
// otherwise. A verb that fails has recorded nothing.

#include <gnomon/backend/depth_kernel.hpp>
#include <gnomon/backend/draw.hpp>
#include <gnomon/backend/error.hpp>
#include <gnomon/backend/fragment.hpp>
#include <gnomon/backend/kernel.hpp>
#include <gnomon/backend/ortho.hpp>
#include <gnomon/backend/pass.hpp>
#include <gnomon/math/bounds.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::backend {

/// What is too large for a backend.
struct Limits {
    std::int32_t target_px = 16384;  ///< Side of a target or viewport.
    std::uint32_t target_layers = 256;
    std::uint64_t target_bytes = std::uint64_t{1} << 32U;  ///< Of all layers of one plane.
    std::uint64_t buffer_bytes = std::uint64_t{1} << 31U;
    /// What the loops of one invocation of a kernel may add up to. Some drivers end longer ones and say nothing.
    std::uint32_t loop_rounds = 0xFFFFFFFFU;
};

/// A stage and how long it took.
struct StageTime {
    std::string_view name;  ///< As `stage` was given it.
    double ms = 0.0;
};

/// A part of one plane of a target.
struct TargetPart {
    TargetId target;
    std::uint32_t layer = 0;
    Plane plane = Plane::depth;
    Rect rect;
};

/// A backend: memory, passes, queries and kernels. One thread at a time.
///
/// After the same calls of one frame were made once, calling them again allocates nothing.
class Backend {
  public:
    virtual ~Backend() = default;
    Backend(Backend const&) = delete;
    Backend& operator=(Backend const&) = delete;

    /// "cpu", "vulkan", "null".
    [[nodiscard]] virtual std::string_view name() const noexcept = 0;
    [[nodiscard]] virtual Limits limits() const noexcept = 0;

    /// Stages draws once, to be drawn any number of times.
    ///
    /// expects: positions, indices, coordinates, texels and matrices stay as they are until the list is released: the
    ///          CPU draws from them, others copy them. The `Draw`s and `AlphaTest`s themselves are copied.
    virtual Result<DrawListId> keep(std::span<Draw const> draws) = 0;
    /// returns: a target whose pixels hold anything until they are cleared.
    virtual Result<TargetId> make_target(TargetConfig const& config) = 0;
    /// returns: a buffer whose bytes hold anything until they are written. 0 bytes are refused.
    virtual Result<BufferId> make_buffer(std::size_t bytes) = 0;
    /// Gives back memory once nothing recorded needs it. The id is unknown from here on.
    virtual Result<Done> release(DrawListId list) = 0;
    virtual Result<Done> release(TargetId target) = 0;
    virtual Result<Done> release(BufferId buffer) = 0;

    /// What follows is timed under this name, up to the next one or `finish`.
    ///
    /// What comes before any, and what follows an empty name, is not timed.
    /// expects: a name that outlives the next `finish`, such as a literal.
    virtual void stage(std::string_view name) = 0;
    /// Fills `bytes.size()` bytes of `buffer`, from `offset` on.
    virtual Result<Done> write(BufferId buffer, std::size_t offset, std::span<std::byte const> bytes) = 0;
    /// Draws a list into areas of a target, each with its own view; with triangle ids if the target has them.
    ///
    /// expects: no pixel in two layers' areas; which pixels those are is said at `PassLayer`.
    /// returns: what was asked for; data that cannot be drawn (an index out of range, a NaN) is left out when drawn.
    virtual Result<PassCounts> draw(DrawListId list, TargetId target, std::span<PassLayer const> layers) = 0;
    /// Draws a list into an area of a target as `draw` does, and gives each fragment that passes the test its colour.
    ///
    /// Fragments of a pixel take effect in the order of the draws. Triangle ids stay as they are. Alpha tests are not made:
    /// a list that has some is drawn first, then shaded with `FragmentTest::visible`; `nearer` refuses it.
    /// expects: a target with colours; `layer.range` clips; of one `draw` and the `shade` after it the same list, layer and
    ///          views, where it is `visible`.
    virtual Result<PassCounts> shade(DrawListId list, TargetId target, PassLayer const& layer,
                                     FragmentKernel const& kernel, FragmentCall const& call) = 0;
    /// Draws a list's nearest depths into layers of a target, in whole units: `raster::ortho_pass` says which, to the bit.
    ///
    /// expects: draws without instances, a target without triangle ids and colours, no pixel in two layers' areas.
    virtual Result<PassCounts> draw_ortho(DrawListId list, TargetId target, std::span<OrthoLayer const> layers) = 0;
    /// Gives each pixel of a part of a target a depth.
    virtual Result<Done> write_depth(DepthKernel const& kernel, DepthCall const& call) = 0;
    /// Writes to `counts[first + i]`, 32 bits each, at how many samples of the view's area box i would pass the depth
    /// test if its faces were drawn, both sides; nothing is drawn. `view.load` and `view.groups` are not looked at.
    ///
    /// Whether a count is 0 is the same on every backend. A sample that two faces of a box pass at may count twice.
    /// An empty box, or one with a NaN, passes nowhere.
    virtual Result<Done> count_samples(std::span<math::Aabb const> boxes, TargetId target, PassLayer const& view,
                                       BufferId counts, std::size_t first) = 0;
    /// Runs a kernel over `call.count` items.
    virtual Result<Done> run(Kernel const& kernel, KernelCall const& call) = 0;
    /// Copies a part of a target's plane to pixel (x, y) of the same plane of `to`, which has the same format.
    ///
    /// Not within one array layer: a map that scrolls has two layers, and changes from one to the other.
    virtual Result<Done> copy(TargetPart const& from, TargetId to, std::uint32_t layer, math::ivec2 const& at) = 0;
    /// Reads back what the buffer holds at this point of the order: `out` is filled when `finish` returns.
    ///
    /// expects: `out` stays until then.
    virtual Result<Done> read(BufferId buffer, std::size_t offset, std::span<std::byte> out) = 0;
    /// The same of a part of a target: packed rows of `bytes_per_pixel`, as many as `out` must hold exactly.
    virtual Result<Done> read(TargetPart const& part, std::span<std::byte> out) = 0;

    /// Returns when all that was recorded is done and read back.
    ///
    /// returns: the stages that have names, in order, until the next call of this.
    virtual Result<std::span<StageTime const>> finish() = 0;

  protected:
    Backend() = default;
};

}  // namespace gnomon::backend
