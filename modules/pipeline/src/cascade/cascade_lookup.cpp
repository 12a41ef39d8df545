// The kernel `cascade_lookup`, its C++ half.

#include "cascade_lookup.hpp"

#include "../shadow/look_up_blocks.hpp"

#include <gnomon/cascade/select.hpp>
#include <shaders/cascade_lookup_comp.hpp>

namespace gnomon::pipeline {

namespace {

void look_up_cascades(backend::KernelData const& data, std::size_t begin, std::size_t end) {
    auto const c = data.constant<CascadeLookupStd>();
    auto const samples = data.buffer<sample::ViewSample const>(0);
    cascade::CascadeDepths const& depths = data.buffer<cascade::CascadeDepths const>(6)[0];
    look_up_blocks(data, {depths.count, c.unorm16 != 0, c.config}, begin, end, [&](std::size_t i) {
        math::vec3 const way = samples[i].position - math::vec3(c.eye[0], c.eye[1], c.eye[2]);
        float const depth_m = (way.x * c.sight[0] + way.y * c.sight[1]) + way.z * c.sight[2];
        cascade::CascadeChoice const choice = cascade::choose_by_depth(depths, depth_m);
        bool const seen = choice.cascade < depths.count;
        return seen ? MapChoice{choice.cascade, choice.next, choice.blend} : MapChoice{.unseen = 1.0F};
    });
}

}  // namespace

constinit backend::Kernel const cascade_lookup_kernel{.name = "cascade_lookup",
                                                      .cpu = &look_up_cascades,
                                                      .spirv = cascade_lookup_comp,
                                                      .buffers = 7,
                                                      .targets = 1,
                                                      .constant_bytes = sizeof(CascadeLookupStd),
                                                      .grain = sample_grain};

}  // namespace gnomon::pipeline
