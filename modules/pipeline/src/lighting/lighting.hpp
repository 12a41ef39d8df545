#pragma once
// What lighting techniques share: lights in both spaces, and the run of the kernel `shade_lists`.

#include <gnomon/cluster.hpp>
#include <gnomon/cull/depth_range.hpp>
#include <gnomon/lights.hpp>
#include <gnomon/pipeline/lighting.hpp>

#include "device_lists.hpp"
#include "forward.hpp"
#include "gbuffer.hpp"
#include "light_kernels.hpp"
#include "tile_kernels.hpp"
#include "../staged.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

/// The lights as shading and as assignment see them; the same place in both lists.
struct PreparedLights {
    std::vector<lights::ShadedLight> shaded;  ///< Work space.
    std::vector<lights::Light> culled;        ///< Culling space of the frame's view.
    float rounding_m = 0.0F;                  ///< What a sample's position, its depth and a light's place are off by, twice that.
    float facing_slack_m = 0.0F;              ///< How far apart the two may have a light and a sample: for culling by normals.
};

/// Keys of samples, and the unique ones.
template <cluster::Key K>
struct KeySet {
    std::vector<K> keys;
    std::vector<K> unique;
    cluster::UniqueWorkspace<K> work;
};

/// Of all lighting techniques: on the backend, and memory of the host.
struct Lighting {
    std::shared_ptr<FrameState const> gbuffer_of;
    GBufferFormat format = GBufferFormat::f32;
    StagedBuffer gbuffer;
    StagedBuffer lights;
    StagedBuffer list_of;
    StagedBuffer sample_of;
    StagedBuffer cells;
    StagedBuffer indices;
    StagedBuffer radiance;
    StagedBuffer computations;

    PreparedLights prepared;
    KeySet<std::uint32_t> keys;
    KeySet<std::uint64_t> wide_keys;           ///< Where those have too few bits.
    std::vector<std::uint32_t> list_of_sample;
    std::vector<lights::Cell> dense_cells;     ///< Of every tile of the grid.
    std::vector<lights::Cell> list_cells;      ///< Of those that are shaded.
    std::vector<std::uint32_t> list_indices;
    std::vector<cull::DepthRange> depth_ranges;
    lights::Workspace assignment;              ///< Of tiles.

    std::vector<cluster::ClusterCoordinates> clusters;  ///< Those with samples.
    std::vector<std::uint32_t> normal_cells;            ///< Of those, where normals are in the key.
    std::vector<math::vec3> sample_vectors;             ///< Positions or normals in culling space.
    std::vector<math::Aabb> boxes;
    std::vector<cluster::NormalCone> cones;
    cluster::ReduceWorkspace reduction;
    lights::LightTreeWorkspace tree_work;
    lights::LightTree tree;
    lights::SparseWorkspace sparse;

    std::vector<float> tile_balls;  ///< Of lights, an array a number.
    StagedBuffer balls;
    StagedBuffer borders;
    StagedBuffer lights_of;
    StagedBuffer hulls;
    StagedBuffer window;  ///< Borders alone.
    StagedBuffer marks;

    DeviceLists on_device;
    ForwardState forward;

    /// Writes the G-buffer unless this frame's is there.
    void fit_gbuffer(Verbs& verbs, Frame const& frame, GBufferFormat wanted, core::ExecutorRef executor);
};

/// Ranges grow by what the rounding of samples may hide: a light that reaches a sample, as shading sees both, is never
/// culled. A light without an end is everywhere.
void prepare_lights(Frame const& frame, std::span<Light const> lights, PreparedLights& out);

/// A parameter that all of these techniques have.
extern ParamInfo const gbuffer_param;
extern ParamInfo const tile_param;

/// Depth in front of the eye of a work-space position, as keys and depth ranges see it.
class SampleDepth {
  public:
    explicit SampleDepth(Frame const& frame) noexcept
        : eye_(math::to_float(frame.view.eye_m - frame.geometry->origin_m)), forward_(math::to_float(-frame.view.back)) {}
    [[nodiscard]] float operator()(math::vec3 const& position) const noexcept {
        return formula::gn_along(formula::Vec3<float>(position - eye_), formula::Vec3<float>(forward_)).v;
    }
    [[nodiscard]] math::vec3 const& eye() const noexcept { return eye_; }
    [[nodiscard]] math::vec3 const& forward() const noexcept { return forward_; }

  private:
    math::vec3 eye_;
    math::vec3 forward_;
};

/// Normal cones that shading's own rounding may not leave: its products err by less than 1e-6 of a radian, and cosines fall
/// by no more than their angle grows.
void widen(std::span<cluster::NormalCone> cones) noexcept;

/// The normals of samples as the G-buffer has them, in culling space.
void turn_normals(LightingRun const& on, GBufferFormat format, std::vector<math::vec3>& out);

/// Tiles alone: one slice without an end. The run has a parameter `tile`.
[[nodiscard]] Result<cluster::Grid> make_tile_grid(LightingRun const& on);
/// A grid of cubical clusters as deep as the samples go.
[[nodiscard]] Result<cluster::Grid> make_cluster_grid(LightingRun const& on);
/// The same up to a depth of the caller's.
[[nodiscard]] Result<cluster::Grid> make_cluster_grid(math::View const& view, std::int32_t tile_px, double deepest_m);
/// In front of the eye; the near plane's where there are no samples.
[[nodiscard]] double deepest_sample(Frame const& frame, core::ExecutorRef executor);

/// The lists of `clustered-deferred` and of `tiled-deferred`, as `shade_lists` takes them.
///
/// expects: prepared lights in the workspace's `Lighting`
[[nodiscard]] Result<lights::ListsReport> find_clustered_lists(LightingRun const& on, std::vector<StageTime>& stages);
[[nodiscard]] Result<lights::ListsReport> find_tiled_lists(LightingRun const& on, std::vector<StageTime>& stages);

/// Lights that techniques evaluate, of all samples together.
struct ComputationCounts {
    std::uint64_t stencil = 0;    ///< `deferred-stencil`: the least.
    std::uint64_t tiled = 0;      ///< `tiled-deferred`
    std::uint64_t clustered = 0;  ///< `clustered-deferred`, whose parameters the run has.
    std::uint64_t clusters = 0;
};

/// What the three would count, without shading: a fraction of their time.
[[nodiscard]] Result<ComputationCounts> count_computations(LightingRun const& on);

/// Records `shade_lists` over lists of up to `longest` lights, in as many runs as that takes.
void run_shade_lists(Verbs& verbs, std::span<backend::BufferId const> buffers, ShadeListsStd constants, std::uint32_t longest);

/// The lists that samples are shaded by, in a `Lighting`: `list_of_sample`, `list_cells`, `list_indices`.
///
/// expects: `begin_lighting` was called. `then` records what comes after the lists, into the same image.
/// returns: the image, its counts and the stages that ran on the device; `stages` of the host come first.
[[nodiscard]] Result<LightingOutput> shade_lists(LightingRun const& on, Verbs& verbs, std::vector<StageTime> stages,
                                                 std::function<void(ShadeListsStd const&)> const& then = {});

/// Reads radiance and computations back and finishes, and counts what both say: `lighting_computations`.
///
/// expects: `stages` of the host, which come first
[[nodiscard]] Result<LightingOutput> read_image(LightingRun const& on, Verbs& verbs, std::vector<StageTime> stages);

/// Where shading looks for the eye: a place in work space, or in an orthographic view the direction toward it.
[[nodiscard]] math::vec3 shading_eye(Frame const& frame) noexcept;

/// Sets up the workspace, the G-buffer and the lights.
[[nodiscard]] Lighting& begin_lighting(LightingRun const& on, Verbs& verbs);

}  // namespace gnomon::pipeline
