#pragma once
// Files and folders that are there whole or not at all: everything is written beside its place and renamed into it.

#include "image_io.hpp"
#include "outcome.hpp"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::command {

struct OutputFile {
    std::string name;
    Bytes bytes;
};

[[nodiscard]] Bytes bytes_of(std::string const& text);

/// Whether `write_folder` could write here now: known before the work instead of after it. Leaves no trace.
///
/// A folder that exists may be replaced if it is empty or holds only what an earlier gnomon wrote into it, by the list
/// in its results.json; anything else is somebody's work.
[[nodiscard]] Outcome<core::Done> check_folder(std::string const& option, std::string const& path);
[[nodiscard]] Outcome<core::Done> check_file(std::string const& option, std::string const& path);

/// A folder written file by file beside its place; it appears when `commit` says so, and leaves no trace before.
class FolderWriter {
  public:
    /// expects: `check_folder` passed.
    [[nodiscard]] static Outcome<FolderWriter> begin(std::string const& path);
    ~FolderWriter();
    FolderWriter(FolderWriter&& other) noexcept;
    FolderWriter& operator=(FolderWriter&&) = delete;

    [[nodiscard]] Outcome<core::Done> add(std::string const& name, Bytes const& bytes);
    /// Names of the files so far, in order.
    [[nodiscard]] std::vector<std::string> const& names() const noexcept { return names_; }
    [[nodiscard]] Outcome<core::Done> commit();

  private:
    explicit FolderWriter(std::string path) : path_(std::move(path)) {}

    std::string path_;  ///< As given; empty once committed or moved from.
    std::vector<std::string> names_;
};

/// expects: `check_folder` passed.
[[nodiscard]] Outcome<core::Done> write_folder(std::string const& path, std::vector<OutputFile> const& files);

/// A device such as /dev/stdout is written directly.
[[nodiscard]] Outcome<core::Done> write_file(std::string const& path, Bytes const& bytes);

}  // namespace gnomon::command
