// Draw lists, targets, passes and queries.

#include "backend_state.hpp"

namespace gnomon::vulkan {

namespace {

core::Failure<backend::Error> not_yet(char const* verb) {
    return {backend::Error::missing_feature, std::string(verb) + ": the Vulkan backend has no passes yet"};
}

}  // namespace

backend::Result<backend::DrawListId> Backend::keep(std::span<backend::Draw const>) { return not_yet("keep"); }
backend::Result<backend::TargetId> Backend::make_target(backend::TargetConfig const&) { return not_yet("make_target"); }
backend::Result<core::Done> Backend::release(backend::DrawListId) { return not_yet("release"); }
backend::Result<core::Done> Backend::release(backend::TargetId) { return not_yet("release"); }
backend::Result<backend::PassCounts> Backend::draw(backend::DrawListId, backend::TargetId,
                                                   std::span<backend::PassLayer const>) {
    return not_yet("draw");
}
backend::Result<core::Done> Backend::count_samples(std::span<math::Aabb const>, backend::TargetId,
                                                   backend::PassLayer const&, backend::BufferId, std::size_t) {
    return not_yet("count_samples");
}
backend::Result<core::Done> Backend::copy(backend::TargetPart const&, backend::TargetId, std::uint32_t,
                                          math::ivec2 const&) {
    return not_yet("copy");
}
backend::Result<core::Done> Backend::read(backend::TargetPart const&, std::span<std::byte>) { return not_yet("read"); }

}  // namespace gnomon::vulkan
