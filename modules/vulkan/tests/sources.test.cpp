#include <gnomon/check/check.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace gnomon;

TEST_CASE("nothing in the module submits or waits, and no file is long", "[vulkan][sources]") {
    namespace fs = std::filesystem;
    fs::path const module = fs::path(__FILE__).parent_path().parent_path();
    int files = 0;
    for (char const* folder : {"include", "src", "shaders"}) {
        if (!fs::exists(module / folder)) continue;
        for (auto const& entry : fs::recursive_directory_iterator(module / folder)) {
            if (!entry.is_regular_file()) continue;
            ++files;
            std::ifstream in(entry.path());
            std::string const text{std::istreambuf_iterator<char>(in), {}};
            INFO(entry.path().string());
            for (char const* call : {"QueueSubmit", "QueueWaitIdle", "DeviceWaitIdle", "WaitForFences", "WaitSemaphores",
                                     "QueueBindSparse", "CreateDevice(", "CreateInstance", "GetDeviceQueue",
                                     "WaitForPresent"})
                CHECK(text.find(call) == std::string::npos);
            // The device may wait for its queries where it copies them; the host never does.
            if (text.find("GetQueryPoolResults") != std::string::npos)
                CHECK(text.find("QUERY_RESULT_WAIT") == std::string::npos);
            CHECK(std::count(text.begin(), text.end(), '\n') <= 300);
        }
    }
    CHECK(files > 35);
}
