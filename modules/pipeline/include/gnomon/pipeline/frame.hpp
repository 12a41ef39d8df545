#pragma once
// A frame: what one camera sees of one scene under one light, and the exact truth about it. Built once; every technique
// then decides the same view samples.
//
// A view sample is (triangle, float3 position) of a pixel whose centre a triangle covers. [design section 9]

#include <gnomon/backend/verbs.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/math/view.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/light.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/scene.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

inline constexpr std::uint32_t no_sample = std::numeric_limits<std::uint32_t>::max();

/// One named duration. Names are the program's literals.
using backend::StageTime;

/// The samples of a frame, one entry per covered pixel in row order; every list has `size()` entries.
struct Samples {
    std::vector<std::uint32_t> pixel;        ///< y * width + x.
    std::vector<std::uint32_t> triangle;     ///< Index into the geometry's triangle list.
    std::vector<math::vec3> position;        ///< Work space: metres from the geometry's origin.
    std::vector<math::vec3> normal;          ///< Unit geometric normal, toward the eye.
    std::vector<math::vec3> shading_normal;  ///< Unit, interpolated; on the eye's side of the surface.
    std::vector<math::vec2> uv;              ///< Base colour texture coordinates.

    [[nodiscard]] std::size_t size() const noexcept { return pixel.size(); }
};

/// What a frame keeps for itself: the triangle list, the truth's hierarchy, alpha tables.
struct FrameState;

/// expects: `scene` and `geometry` outlive the frame.
struct Frame {
    scene::Scene const* scene = nullptr;
    scene::Geometry const* geometry = nullptr;
    math::View view;
    Light light;
    math::vec3 light_position{0.0F};  ///< Work space, rounded once; point and spot.
    math::vec3 to_light{0.0F};        ///< Toward a directional light, rounded once; not of unit length.
    math::Aabb bounds;                ///< Of every finite vertex, work space.
    Samples samples;
    std::vector<std::uint32_t> sample_of_pixel;  ///< `no_sample` for the background.
    std::vector<std::uint8_t>
        lit;  ///< The truth: 1 lit, 0 in shadow; one per sample. Empty where it was not asked for.
    std::vector<std::uint8_t> reached;  ///< 0: beyond the light's range or cone, so not lit whatever stands between.
    std::uint64_t bad_triangles = 0;    ///< Left out: a vertex is not finite, or an index out of range.
    std::uint64_t triangles_drawn = 0;  ///< Of the camera pass.
    bool leaves_out_blended = false;    ///< BLEND surfaces have no samples; otherwise they count as masked at one half.
    std::shared_ptr<FrameState const> state;
    std::vector<StageTime> stages;  ///< camera_pass, samples, truth_build, truth_trace.
};

/// How view samples are placed.
enum class SampleRule : std::uint8_t {
    exact,    ///< In double, and exactly on the eye's side of the own plane: what tests of visibility need.
    formula,  ///< By formula/surface.glsl, in float: what fragment shaders compute of triangle and pixel, to the bit.
};

/// One picture to take.
struct Shot {
    math::View view;
    Light light;
    bool truth = true;  ///< Off: no exact shadows, so no errors; a fraction of the time.
    /// A frame of the same scene and geometry, neither changed since: its hierarchy serves again. May be null.
    Frame const* before = nullptr;
    SampleRule samples = SampleRule::exact;
    bool leaves_out_blended = false;  ///< On: BLEND surfaces have no samples; see `shade_transparent`.
};

/// Draws the camera pass, places the view samples and traces the truth.
///
/// expects: `geometry` is `flatten`ed from `scene`.
/// returns: a frame with no samples when the view sees nothing of the scene; an error for a bad light or view, or for a
///          geometry without triangles.
[[nodiscard]] Result<Frame> make_frame(scene::Scene const& scene, scene::Geometry const& geometry, Shot const& shot,
                                       core::ExecutorRef executor);
[[nodiscard]] Result<Frame> make_frame(scene::Scene const& scene, scene::Geometry const& geometry,
                                       math::View const& view, Light const& light, core::ExecutorRef executor);

[[nodiscard]] inline bool has_truth(Frame const& frame) noexcept { return frame.lit.size() == frame.samples.size(); }

}  // namespace gnomon::pipeline
