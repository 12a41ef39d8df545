#include "backend_state.hpp"

#include <cstring>

namespace gnomon::vulkan {

namespace {

// `finish` waits, so one frame is in flight, and its memory is free when the next begins.
constexpr std::uint32_t frames = 1;

}  // namespace

Backend::State::State(GpuRef device, Host const& owner)
    : gpu(std::move(device)),
      host(owner),
      uploads(gpu, {.frames = frames, .use = MemoryUse::upload}),
      downloads(gpu, {.frames = frames, .use = MemoryUse::read_back}),
      sets(gpu, frames),
      timer(gpu, frames) {}

core::Failure<Error> Backend::State::end(core::Failure<Error> failure) {
    open = VK_NULL_HANDLE;
    reads.clear();
    ended = failure;
    return failure;
}

Result<VkCommandBuffer> Backend::State::commands() {
    if (ended) return *ended;
    if (open != VK_NULL_HANDLE) return open;
    count.finished = count.recording;
    if (auto ok = uploads.begin_frame(count); !ok) return std::move(ok).failure();
    if (auto ok = downloads.begin_frame(count); !ok) return std::move(ok).failure();
    if (auto ok = sets.begin_frame(count); !ok) return std::move(ok).failure();
    if (auto ok = timer.begin_frame(count); !ok) return std::move(ok).failure();
    VkCommandBuffer given = VK_NULL_HANDLE;
    VkResult const result = host.begin(host.context, given);
    if (result != VK_SUCCESS) {
        auto failure = failure_of(result, "Host::begin");
        return failure.code == Error::device_lost ? end(std::move(failure)) : std::move(failure);
    }
    if (given == VK_NULL_HANDLE) return core::Failure{Error::bad_argument, "Host::begin gave no command buffer"};
    open = given;
    order.all();  // after the frame before
    order.apply(*gpu, open);
    return open;
}

Result<core::Done> Backend::State::close(VkCommandBuffer commands) {
    if (auto ok = timer.end_frame(commands); !ok) stage_failure = std::move(ok).failure();
    if (!reads.empty()) order_for_host(*gpu, commands);
    return uploads.flush();
}

Result<core::Done> Backend::State::submit() {
    if (auto ok = close(open); !ok) return end(std::move(ok).failure());
    VkResult const result = host.submit_and_wait(host.context, open);
    if (result != VK_SUCCESS) return end(failure_of(result, "Host::submit_and_wait"));
    open = VK_NULL_HANDLE;
    ++count.recording;
    count.finished = count.recording;
    for (backend::DrawListId const id : uploading)
        if (DrawList* const list = lists.find(id)) list->release_staging();
    uploading.clear();
    retired_lists.clear();
    retired_targets.clear();
    retired_buffers.clear();
    return core::Done{};
}

Result<core::Done> Backend::State::deliver() {
    for (PendingRead const& read : reads) {
        HostSlice const& slice = read.slice;
        if (auto ok = invalidate(*gpu, slice.memory, slice.offset, slice.bytes.size()); !ok)
            return end(std::move(ok).failure());
        std::memcpy(read.out.data(), slice.bytes.data(), read.out.size());
    }
    reads.clear();
    return core::Done{};
}

Result<core::Done> Backend::State::collect_times() {
    if (stage_failure) {
        core::Failure<Error> failure = *std::move(stage_failure);
        stage_failure.reset();
        return failure;
    }
    auto const stages = timer.times(count.recording - 1, count.finished);
    if (!stages) return stages.failure();
    for (StageMs const& s : *stages) times.push_back({s.name, s.ms});
    return core::Done{};
}

Result<ComputeKernel const*> Backend::State::compiled(backend::Kernel const& kernel) {
    for (CompiledKernel const& known : kernels)
        if (known.kernel == &kernel) return &known.compute;
    if (kernel.spirv.empty())
        return core::Failure{Error::missing_feature,
                             "kernel '" + std::string(kernel.name) + "' has no SPIR-V: it runs on the CPU alone"};
    auto made = ComputeKernel::make(gpu, {.name = kernel.name,
                                          .spirv = kernel.spirv,
                                          .buffers = kernel.buffers,
                                          .targets = kernel.targets,
                                          .constant_bytes = kernel.constant_bytes});
    if (!made) return std::move(made).failure();
    kernels.push_back({&kernel, *std::move(made)});
    return &kernels.back().compute;
}

Result<FragmentPipeline*> Backend::State::compiled(backend::FragmentKernel const& kernel) {
    for (CompiledFragmentKernel& known : fragment_kernels)
        if (known.kernel == &kernel) return &known.pipeline;
    if (kernel.spirv.empty())
        return core::Failure{Error::missing_feature,
                             "kernel '" + std::string(kernel.name) + "' has no SPIR-V: it shades on the CPU alone"};
    auto shared = passes();
    if (!shared) return std::move(shared).failure();
    auto made = FragmentPipeline::make(*shared, kernel);
    if (!made) return std::move(made).failure();
    fragment_kernels.push_back({&kernel, *std::move(made)});
    return &fragment_kernels.back().pipeline;
}

Result<DepthPipeline*> Backend::State::compiled(backend::DepthKernel const& kernel) {
    for (CompiledDepthKernel& known : depth_kernels)
        if (known.kernel == &kernel) return &known.pipeline;
    if (kernel.spirv.empty())
        return core::Failure{Error::missing_feature,
                             "kernel '" + std::string(kernel.name) + "' has no SPIR-V: it writes depths on the CPU alone"};
    auto made = DepthPipeline::make(gpu, kernel);
    if (!made) return std::move(made).failure();
    depth_kernels.push_back({&kernel, *std::move(made)});
    return &depth_kernels.back().pipeline;
}

Result<PassPipelinesRef> Backend::State::passes() {
    if (pass_pipelines != nullptr) return pass_pipelines;
    auto made = make_pass_pipelines(gpu);
    if (made) pass_pipelines = *made;
    return made;
}

Result<SampleQueries*> Backend::State::counting() {
    if (queries) return &*queries;
    auto made = SampleQueries::make(gpu);
    if (!made) return std::move(made).failure();
    queries.emplace(*std::move(made));
    return &*queries;
}

Result<OrthoPipelines*> Backend::State::ortho() {
    if (ortho_pipelines) return &*ortho_pipelines;
    auto shared = passes();
    if (!shared) return std::move(shared).failure();
    auto made = OrthoPipelines::make(*shared, ortho_config);
    if (!made) return std::move(made).failure();
    ortho_pipelines.emplace(*std::move(made));
    return &*ortho_pipelines;
}

Result<HostSlice> Backend::State::take_read(std::span<std::byte> out) {
    auto slice = downloads.take(out.size());
    if (!slice) return slice;
    reads.push_back({out, *slice});
    return slice;
}

core::Failure<backend::Error> to_backend(core::Failure<Error> failure) {
    auto const code = [&] {
        switch (failure.code) {
            case Error::device_lost: return backend::Error::device_lost;
            case Error::out_of_host_memory:
            case Error::out_of_device_memory: return backend::Error::out_of_memory;
            case Error::unsupported_format: return backend::Error::unsupported_format;
            case Error::too_large: return backend::Error::too_large;
            case Error::bad_argument: return backend::Error::bad_argument;
            case Error::no_vulkan:
            case Error::missing_feature:
            case Error::shader_rejected:
            case Error::driver: return backend::Error::missing_feature;
        }
        return backend::Error::missing_feature;
    }();
    return {code, std::move(failure.message)};
}

}  // namespace gnomon::vulkan
