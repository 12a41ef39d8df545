#pragma once
// Frames in flight: what the per-frame adapters (rings, read-back, descriptor sets, timers) are told about time.

#include <gnomon/vulkan/error.hpp>

#include <cstdint>

namespace gnomon::vulkan {

/// Which frame is being recorded, and what the caller's own fence or timeline semaphore says about those before. Frames
/// count from 0.
struct FrameCount {
    std::uint64_t recording = 0;
    std::uint64_t finished = 0;  ///< Frames [0, finished) are done on the device.
};

/// The place of the frame in a ring of `frames` places.
///
/// returns: `bad_argument` while the frame that used the place before may still run, so that a ring never overwrites
///          what is in flight; `frames` 1 needs each frame finished before the next.
[[nodiscard]] Result<std::uint32_t> slot_of(FrameCount const& count, std::uint32_t frames);

}  // namespace gnomon::vulkan
