#pragma once
// One shadow map's lookup: texel size, bias, filter.

#include <gnomon/shadow/bias.hpp>
#include <gnomon/shadow/filter.hpp>
#include <gnomon/shadow/look_up_many.hpp>
#include <gnomon/shadow/lookup.hpp>
#include <gnomon/shadow/map_view.hpp>
#include <gnomon/shadow/receiver.hpp>
