#pragma once
// Runs a fuzz target without libFuzzer: its seeds, then a fixed number of mutations of them, the same ones on every
// machine and with any compiler. What dies or hangs says which input it was.

#include <gnomon/check/fuzz_input.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#if defined(__unix__)
#include <unistd.h>
#endif

extern "C" void __sanitizer_set_death_callback(void (*)()) __attribute__((weak));

namespace gnomon::check {

namespace detail {

/// Puts one of the words that break programs somewhere.
inline void fuzz_put_word(std::vector<std::uint8_t>& bytes, FuzzRandom& random) {
    static constexpr std::uint32_t words[] = {0,           1,           0xFFFFFFFFU, 0x7FFFFFFFU, 0x80000000U,
                                              0x7F800000U, 0xFF800000U, 0x7FC00000U, 0x00000001U, 0x00800000U,
                                              0x3F800000U, 0xBF800000U, 0x5D800000U, 0x33800000U, 0x7F7FFFFFU,
                                              0x4B800000U, 0x0000FFFFU, 0x3F000000U};
    std::uint32_t const word = words[random.below(std::size(words))];
    std::size_t const n = bytes.size() < 4 ? bytes.size() : 4;
    std::size_t at = random.below(bytes.size() - n + 1);
    if ((random.next() & 1U) != 0) at &= ~std::size_t{3};
    if (n != 0) std::memcpy(bytes.data() + at, &word, n);
}

/// Copies, removes or repeats a run of bytes.
inline void fuzz_move_run(std::vector<std::uint8_t>& bytes, FuzzRandom& random) {
    using Difference = std::vector<std::uint8_t>::difference_type;
    std::size_t const from = random.below(bytes.size());
    std::size_t const length = 1 + random.below(bytes.size() - from < 64 ? bytes.size() - from : 64);
    auto const begin = bytes.begin() + static_cast<Difference>(from);
    auto const end = begin + static_cast<Difference>(length <= bytes.size() - from ? length : bytes.size() - from);
    std::vector<std::uint8_t> const run(begin, end);
    std::size_t const to = random.below(bytes.size() - run.size() + 1);
    switch (random.below(3)) {
        case 0: bytes.erase(begin, end); break;
        case 1: std::memcpy(bytes.data() + to, run.data(), run.size()); break;
        default: bytes.insert(bytes.begin() + static_cast<Difference>(to), run.begin(), run.end()); break;
    }
}

inline void fuzz_mutate_once(std::vector<std::uint8_t>& bytes, FuzzSeeds const& seeds, FuzzRandom& random) {
    if (bytes.empty()) bytes.push_back(0);
    std::size_t const at = random.below(bytes.size());
    switch (random.below(8)) {
        case 0: bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << random.below(8))); break;
        case 1: bytes[at] = static_cast<std::uint8_t>(random.next()); break;
        case 2:
        case 3: fuzz_put_word(bytes, random); break;
        case 4: bytes[at] = static_cast<std::uint8_t>("0123456789-.,:{}[]\"e"[random.below(20)]); break;
        case 5: fuzz_move_run(bytes, random); break;
        case 6: bytes[at] = static_cast<std::uint8_t>(bytes[at] + random.below(5) + 254); break;
        default: {  // The tail of another seed, or nothing.
            std::vector<std::uint8_t> const& other = seeds.seeds[random.below(seeds.seeds.size())].bytes;
            bytes.resize(at);
            if (at < other.size() && (random.next() & 3U) != 0)
                bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(at), other.end());
        }
    }
}

/// Mutation `number` of the seeds: the same everywhere, whatever came before it.
inline std::vector<std::uint8_t> fuzz_mutation(FuzzSeeds const& seeds, std::uint64_t number) {
    FuzzRandom random{number * 0xD1342543DE82EF95ULL + 1};
    std::vector<std::uint8_t> bytes = seeds.seeds[static_cast<std::size_t>(number % seeds.seeds.size())].bytes;
    for (std::size_t n = 1 + random.below(6); n != 0; --n) fuzz_mutate_once(bytes, seeds, random);
    return bytes;
}

/// What is running, for the last words of a process that dies in it.
inline char fuzz_running[256] = "nothing yet";

inline void fuzz_last_words() { std::fprintf(stderr, "fuzz: it happened in %s\n", fuzz_running); }

extern "C" inline void gnomon_fuzz_on_signal(int signal_number) {
    fuzz_last_words();
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

inline void fuzz_watch() {
    std::signal(SIGABRT, &gnomon_fuzz_on_signal);
    if (__sanitizer_set_death_callback != nullptr) {
        __sanitizer_set_death_callback(&fuzz_last_words);
    } else {
        std::signal(SIGSEGV, &gnomon_fuzz_on_signal);
        std::signal(SIGFPE, &gnomon_fuzz_on_signal);
        std::signal(SIGILL, &gnomon_fuzz_on_signal);
    }
#if defined(__unix__)
    std::signal(SIGALRM, &gnomon_fuzz_on_signal);
#endif
}

struct FuzzOptions {
    std::uint64_t first = 0;
    std::uint64_t mutations = 2000;
    double seconds = 20.0;
    std::string corpus;              // Where the seeds are written instead of being run.
    std::vector<std::string> files;  // Run instead of the seeds.
};

inline FuzzOptions fuzz_options(int argc, char** argv) {
    FuzzOptions options;
    for (int i = 1; i < argc; ++i) {
        std::string const name = argv[i];
        bool const has_value = i + 1 < argc;
        if (name == "--mutations" && has_value)
            options.mutations = std::strtoull(argv[++i], nullptr, 10);
        else if (name == "--seconds" && has_value)
            options.seconds = std::strtod(argv[++i], nullptr);
        else if (name == "--write-corpus" && has_value)
            options.corpus = argv[++i];
        else if (name == "--only" && has_value) {
            options.first = std::strtoull(argv[++i], nullptr, 10);
            options.mutations = 1;
        } else if (name.starts_with("-")) {
            std::printf("usage: [--mutations N] [--seconds S] [--only MUTATION] [--write-corpus FOLDER] [FILES]\n");
            std::exit(name == "--help" ? 0 : 2);
        } else {
            options.files.push_back(name);
        }
    }
    return options;
}

/// returns: whether all files were written.
inline bool fuzz_write_corpus(FuzzSeeds const& seeds, std::string const& folder) {
    bool good = true;
    for (FuzzSeeds::Seed const& seed : seeds.seeds) {
        std::string const path = folder + "/" + seed.name;
        std::FILE* const file = std::fopen(path.c_str(), "wb");
        if (file == nullptr) {
            std::fprintf(stderr, "fuzz: cannot write %s\n", path.c_str());
            return false;
        }
        good = std::fwrite(seed.bytes.data(), 1, seed.bytes.size(), file) == seed.bytes.size() && good;
        good = std::fclose(file) == 0 && good;
    }
    return good;
}

inline bool fuzz_read_file(std::string const& path, std::vector<std::uint8_t>& bytes) {
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    if (file == nullptr) return false;
    bytes.clear();
    std::uint8_t buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) != 0;)
        bytes.insert(bytes.end(), buffer, buffer + n);
    return std::fclose(file) == 0;
}

using FuzzRun = void (*)(std::span<std::uint8_t const>);

/// Runs inputs one by one, watches each for hanging, and remembers the slowest.
class FuzzDriver {
  public:
    explicit FuzzDriver(FuzzRun target) : run_(target), begin_(Clock::now()) {}

    void run(std::vector<std::uint8_t> const& bytes, char const* what, std::uint64_t number) {
        std::snprintf(fuzz_running, sizeof fuzz_running, "%s %llu (%zu bytes)", what,
                      static_cast<unsigned long long>(number), bytes.size());
#if defined(__unix__)
        alarm(60);
#endif
        auto const begin = Clock::now();
        run_(bytes);
        double const seconds = since(begin);
        ++count_;
        if (seconds <= slowest_) return;
        slowest_ = seconds;
        slowest_name_ = fuzz_running;
    }
    [[nodiscard]] double seconds() const { return since(begin_); }
    void report() const {
        std::printf("fuzz: %llu inputs in %.1f s, the slowest took %.0f ms: %s\n",
                    static_cast<unsigned long long>(count_), seconds(), slowest_ * 1e3, slowest_name_.c_str());
    }

  private:
    using Clock = std::chrono::steady_clock;
    static double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

    FuzzRun run_;
    Clock::time_point begin_;
    std::uint64_t count_ = 0;
    double slowest_ = 0.0;
    std::string slowest_name_;
};

inline int fuzz_main(FuzzOptions const& options, FuzzRun run, FuzzSeeds const& seeds) {
    fuzz_watch();
    if (!options.corpus.empty()) return fuzz_write_corpus(seeds, options.corpus) ? 0 : 1;
    FuzzDriver driver(run);
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < options.files.size(); ++i) {
        if (!fuzz_read_file(options.files[i], bytes)) {
            std::fprintf(stderr, "fuzz: cannot read %s\n", options.files[i].c_str());
            return 2;
        }
        driver.run(bytes, options.files[i].c_str(), i);
    }
    bool const all = options.files.empty() && !seeds.seeds.empty();
    for (std::size_t i = 0; all && options.first == 0 && i < seeds.seeds.size(); ++i)
        driver.run(seeds.seeds[i].bytes, seeds.seeds[i].name.c_str(), i);
    for (std::uint64_t i = 0; all && i < options.mutations; ++i) {
        if (driver.seconds() > options.seconds) {
            std::printf("fuzz: time is up after %llu of %llu mutations\n", static_cast<unsigned long long>(i),
                        static_cast<unsigned long long>(options.mutations));
            break;
        }
        driver.run(fuzz_mutation(seeds, options.first + i), "--only", options.first + i);
    }
    driver.report();
    return 0;
}

}  // namespace detail
}  // namespace gnomon::check
