#pragma once
// Runs the real command and keeps what it says. Each test has a folder of its own that is gone afterwards.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::command {

namespace fs = std::filesystem;

inline std::string read_text(fs::path const& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_text(fs::path const& path, std::string const& text) { std::ofstream(path, std::ios::binary) << text; }

class TestFolder {
  public:
    TestFolder() {
        std::string name = (fs::temp_directory_path() / "gnomon-command-XXXXXX").string();
        if (mkdtemp(name.data()) != nullptr) path_ = name;
    }
    ~TestFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    TestFolder(TestFolder const&) = delete;
    TestFolder& operator=(TestFolder const&) = delete;

    [[nodiscard]] fs::path operator/(std::string const& name) const { return path_ / name; }
    [[nodiscard]] fs::path const& path() const { return path_; }

    /// Names in the folder, hidden ones too, sorted.
    [[nodiscard]] std::vector<std::string> entries() const {
        std::vector<std::string> names;
        for (auto const& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

  private:
    fs::path path_;
};

struct Ended {
    int exit_code = -1;  ///< Negative: by a signal.
    std::string out;
    std::string err;
};

/// In the child: by descriptor, as closing a stream would write out what the parent had in its buffer.
inline bool redirected(int descriptor, std::string const& path) {
    int const file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    return file >= 0 && dup2(file, descriptor) == descriptor;
}

/// Starts the command in `folder`, as a shell would, with its output in files outside of it.
inline Ended gnomon_in(fs::path const& folder, std::vector<std::string> arguments) {
    TestFolder const logs;
    std::string const out = (logs / "out").string();
    std::string const err = (logs / "err").string();
    arguments.insert(arguments.begin(), GNOMON_BINARY);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t const child = fork();
    if (child == 0) {
        bool const ready = chdir(folder.c_str()) == 0 && redirected(1, out) && redirected(2, err);
        if (ready) execv(argv[0], argv.data());
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_text(out), read_text(err)};
}

}  // namespace gnomon::command
