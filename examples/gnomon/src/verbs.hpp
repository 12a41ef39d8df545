#pragma once
// What the verbs do.

#include "options.hpp"

namespace gnomon::command {

/// `render` and `compare` of one view.
[[nodiscard]] Outcome<core::Done> run(RunOptions const& options);
/// `flythrough`; `render` and `compare` along a path.
[[nodiscard]] Outcome<core::Done> fly(RunOptions const& options);
/// `bench lights`.
[[nodiscard]] Outcome<core::Done> bench_lights(BenchOptions const& options);
/// `bench cascades`.
[[nodiscard]] Outcome<core::Done> bench_cascades(BenchOptions const& options);
[[nodiscard]] Outcome<core::Done> list_or_write_scenes(ScenesOptions const& options);
[[nodiscard]] Outcome<core::Done> show_info();
/// `info --devices`.
[[nodiscard]] Outcome<core::Done> show_devices();

/// Prints to standard output; a full disk or a closed pipe is a failure, not silence.
[[nodiscard]] Outcome<core::Done> print(std::string const& text);

}  // namespace gnomon::command
