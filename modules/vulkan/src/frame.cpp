#include <gnomon/vulkan/frame.hpp>

#include <string>

namespace gnomon::vulkan {

Result<std::uint32_t> slot_of(FrameCount const& count, std::uint32_t frames) {
    if (frames == 0) return core::Failure{Error::bad_argument, "a ring of 0 frames in flight: it needs at least 1"};
    if (count.recording >= count.finished && count.recording - count.finished >= frames)
        return core::Failure{Error::bad_argument, "frame " + std::to_string(count.recording) + " would overwrite frame " +
                                                      std::to_string(count.recording - frames) +
                                                      ", which is not known to have finished: wait for it, or keep more "
                                                      "than " +
                                                      std::to_string(frames) + " frames in flight"};
    return static_cast<std::uint32_t>(count.recording % frames);
}

}  // namespace gnomon::vulkan
