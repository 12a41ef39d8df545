#pragma once
// Why a backend refuses or fails. Every failure carries a sentence that names the value and what to change.

#include <gnomon/core/result.hpp>

#include <cstdint>

namespace gnomon::backend {

enum class Error : std::uint8_t {
    device_lost,         ///< The device stopped: nothing of this backend works any more; make a new one.
    out_of_memory,       ///< The host or the device has no room: nothing was made; release something or ask for less.
    missing_feature,     ///< The device, or a kernel without a half for it, cannot do this: the message names it.
    unsupported_format,  ///< The device cannot draw or read this format: use the one that the message names.
    too_large,           ///< Beyond `Limits`: the message gives the value and the limit.
    bad_argument,        ///< An unknown id, a layer or range outside of its resource: nothing was recorded.
};

template <class T>
using Result = core::Result<T, Error>;
using core::Done;

/// "device_lost", "out_of_memory" ...
[[nodiscard]] constexpr char const* name_of(Error error) noexcept {
    switch (error) {
        case Error::device_lost: return "device_lost";
        case Error::out_of_memory: return "out_of_memory";
        case Error::missing_feature: return "missing_feature";
        case Error::unsupported_format: return "unsupported_format";
        case Error::too_large: return "too_large";
        case Error::bad_argument: return "bad_argument";
    }
    return "unknown";
}

}  // namespace gnomon::backend
