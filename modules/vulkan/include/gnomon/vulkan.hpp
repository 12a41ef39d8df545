#pragma once
// Adapters over the caller's own Vulkan 1.3 device: they record into the caller's command buffer, and never submit,
// wait or own the device.

#include <gnomon/vulkan/backend.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/bins.hpp>
#include <gnomon/vulkan/descriptors.hpp>
#include <gnomon/vulkan/draws.hpp>
#include <gnomon/vulkan/error.hpp>
#include <gnomon/vulkan/features.hpp>
#include <gnomon/vulkan/frame.hpp>
#include <gnomon/vulkan/functions.hpp>
#include <gnomon/vulkan/gpu.hpp>
#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/ortho.hpp>
#include <gnomon/vulkan/pass.hpp>
#include <gnomon/vulkan/pass_pipelines.hpp>
#include <gnomon/vulkan/queries.hpp>
#include <gnomon/vulkan/read_back.hpp>
#include <gnomon/vulkan/resources.hpp>
#include <gnomon/vulkan/ring.hpp>
#include <gnomon/vulkan/scan.hpp>
#include <gnomon/vulkan/shader.hpp>
#include <gnomon/vulkan/spirv.hpp>
#include <gnomon/vulkan/staging.hpp>
#include <gnomon/vulkan/target.hpp>
#include <gnomon/vulkan/timestamps.hpp>
