#pragma once
// Why the pipeline refuses something. Every failure carries a sentence that names the value and what to do.

#include <gnomon/core/result.hpp>

#include <cstdint>
#include <string>

namespace gnomon::pipeline {

enum class Error : std::uint8_t {
    unknown_technique,  ///< No technique has this name: the message lists those that exist.
    unknown_parameter,  ///< The technique has no such parameter: the message lists those it has.
    bad_value,          ///< Not a number, out of range, or not one of the choices: the message lists what is legal.
    bad_light,          ///< A direction of zero length, a NaN, a cone outside (0, 90) degrees, a range of 0 or less.
    bad_view,           ///< The view has no pixels or does not see with finite numbers.
    empty_scene,        ///< The geometry has no triangle that can be drawn.
    too_large,          ///< An image or map would not fit in the limits: the message says what it needs.
    backend_failed,     ///< The backend refused or failed: the message has its name, its error and its own sentence.
};

template <class T>
using Result = core::Result<T, Error>;

}  // namespace gnomon::pipeline
