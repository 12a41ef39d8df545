#pragma once
// Techniques as data: a name, parameters that describe themselves, and a function from a frame to visibilities.

#include <gnomon/backend/verbs.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/error.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/pipeline/image.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::pipeline {

enum class ParamKind : std::uint8_t {
    integer,
    real,
    choice,
};

/// One parameter of a technique, as `--help`, an error message or an HTML page shows it.
struct ParamInfo {
    std::string_view name;
    ParamKind kind = ParamKind::real;
    std::string_view default_text;  ///< As a user would write it.
    double min = 0.0;               ///< Numbers: the legal range, inclusive.
    double max = 0.0;
    std::string_view unit;                      ///< "texels", "m", "" ...
    std::span<std::string_view const> choices;  ///< Choices: every legal word. Integers: the legal values, if few.
    std::string_view doc;
};

/// A parameter as the user wrote it.
struct Setting {
    std::string name;
    std::string text;
};

/// Checked values, one for each of a technique's parameters, in the technique's order.
struct Params {
    struct Value {
        std::string_view name;
        std::string text;     ///< In the canonical form that reports show.
        double number = 0.0;  ///< Numbers; for choices their index in `choices`.
        ParamKind kind = ParamKind::real;
    };

    /// expects: `name` is one of the technique's parameters.
    [[nodiscard]] double number(std::string_view name) const noexcept;
    [[nodiscard]] int integer(std::string_view name) const noexcept { return static_cast<int>(number(name)); }
    [[nodiscard]] std::string_view word(std::string_view name) const noexcept;

    std::vector<Value> values;
};

/// One named number of a report: a count or a number of bytes.
struct Count {
    std::string_view name;
    std::uint64_t value = 0;
};

/// A picture of how a technique came to its result.
struct DebugPicture {
    std::string_view name;     ///< Of files: a word.
    std::string_view caption;  ///< What is to be seen, in sentences.
    Image image;
};

/// What a technique gives: per sample and in total.
struct TechniqueOutput {
    std::vector<float> visibility;      ///< In [0, 1], one per sample; 1 is lit.
    std::vector<float> bias_m;          ///< How far the occluder test was moved toward the light; empty: nowhere.
    std::vector<std::uint8_t> own_hit;  ///< 1: what blocks here is the sample's own or an adjoining triangle; or empty.
    std::vector<StageTime> stages;      ///< In order; their sum is the run's time.
    std::vector<Count> counts;          ///< By the names of design section 10.
    std::vector<Count> bytes;
    std::vector<Count> redraw_reasons;  ///< Of techniques that keep maps: why each was drawn to, of a part of it too.
    std::vector<double> map_texel_m;     ///< Of cascades: the side of a texel of each map.
    std::vector<DebugPicture> pictures;  ///< If they were asked for, and the technique has any.
    /// Likewise: a colour for each sample, linear RGB, such as that of the map it looks into; or empty.
    std::vector<math::vec3> tint;
};

/// What a technique leaves on a backend for its next run: what was staged of a frame and its geometry, maps, buffers.
///
/// What did not change since the last run is not staged again. Its contents belong to the backend that ran last: a run
/// on another releases them and begins anew.
/// expects: that backend outlives the workspace, or the workspace's `clear`.
class Workspace {
  public:
    Workspace();
    ~Workspace();
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;

    /// Releases all that a backend holds for it.
    void clear() noexcept;
    /// A CPU backend of its own, for whoever brings none; runs on `executor` from here on.
    [[nodiscard]] backend::Backend& own_backend(core::ExecutorRef executor);

    struct State;
    [[nodiscard]] State& state() noexcept { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

/// All that a technique is given.
struct TechniqueRun {
    Frame const& frame;
    Params const& params;
    Workspace& workspace;
    backend::Backend& device;    ///< Draws, and runs the kernels.
    core::ExecutorRef executor;  ///< For what the host does: fitting, building, measuring.
    bool debug = false;          ///< Debug pictures are wanted. Making them is in no stage's time.
};

/// A technique. Plain data: the table is the only registry.
struct Technique {
    std::string_view name;
    std::string_view summary;  ///< One line.
    std::span<ParamInfo const> params;
    Result<TechniqueOutput> (*run)(TechniqueRun const& on);
    /// Un-timed extra for the measures, straight after `run`: fills `own_hit`. Null where there is nothing to add.
    Result<core::Done> (*examine)(TechniqueRun const& on, TechniqueOutput& output);
    bool suns_only = false;   ///< Another light than a directional one is an error.
    bool keeps_maps = false;  ///< What one run draws the next may keep: the same frame again costs less, and says nothing.
};

/// Every technique there is.
[[nodiscard]] std::span<Technique const> techniques() noexcept;

/// returns: the technique, or a failure that names the unknown one and lists those that exist.
[[nodiscard]] Result<Technique const*> find_technique(std::string_view name);

/// Defaults, overridden by `settings` in order.
///
/// returns: values for every parameter, or a failure that names the parameter or value and lists what is legal.
[[nodiscard]] Result<Params> make_params(Technique const& technique, std::span<Setting const> settings = {});

}  // namespace gnomon::pipeline
