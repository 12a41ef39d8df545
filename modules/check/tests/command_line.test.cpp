// The harness judged from outside: a program with failing tests is run, its output and exit code compared.
#include <gnomon/check/check.hpp>

#include <cstdio>
#include <string>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/wait.h>
#include <unistd.h>

namespace {

struct Run {
    int code;
    std::string out;
    [[nodiscard]] bool has(std::string const& text) const { return out.find(text) != std::string::npos; }
    [[nodiscard]] std::size_t count(std::string const& text) const {
        std::size_t n = 0;
        for (std::size_t at = out.find(text); at != std::string::npos; at = out.find(text, at + 1)) ++n;
        return n;
    }
};

Run run_selftest(std::string const& arguments) {
    std::string const command = std::string("\"") + GNOMON_CHECK_SELFTEST + "\" " + arguments + " 2>&1";
    std::FILE* const pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    Run run{-1, {}};
    char buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) run.out.append(buffer, n);
    int const status = pclose(pipe);
    run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return run;
}

std::string names(std::string const& filter) { return run_selftest(filter + " --list-test-names-only").out; }

/// What stands behind "replay: PROGRAM" in a report.
std::string replay_arguments(Run const& run) {
    std::size_t const at = run.out.find("replay: ");
    if (at == std::string::npos) return {};
    std::size_t const begin = run.out.find(' ', at + 8);
    return run.out.substr(begin, run.out.find('\n', begin) - begin);
}

/// A reader of the XML that reports use: complains about tags that do not match, bare & and <, bad characters.
class XmlReader {
public:
    explicit XmlReader(std::string text) : text_(std::move(text)) {}

    [[nodiscard]] std::string complaint() {
        while (at_ < text_.size() && error_.empty()) text_[at_] == '<' ? tag() : character();
        if (error_.empty() && !open_.empty()) error_ = "not closed: " + open_.back();
        return error_;
    }

private:
    void character() {
        auto const c = static_cast<unsigned char>(text_[at_]);
        if (c < 0x20 && c != '\n' && c != '\t') error_ = "control character";
        if (c == '&') entity();
        if (c >= 0xf8 || c == 0xc0 || c == 0xc1 || c == 0xff) error_ = "not UTF-8";
        ++at_;
    }
    void entity() {
        std::string const name = text_.substr(at_, text_.find(';', at_) - at_ + 1);
        for (char const* known : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#10;", "&#9;"})
            if (name == known) return;
        error_ = "entity " + name;
    }
    void tag() {
        std::size_t const begin = ++at_;
        while (at_ < text_.size() && text_[at_] != '>') {
            if (text_[at_] == '<') error_ = "< inside a tag";
            character();
        }
        std::string const body = text_.substr(begin, at_++ - begin);
        std::string const name = body.substr(0, body.find(' '));
        if (body[0] == '?') return;
        if (body[0] == '/') {
            if (open_.empty() || "/" + open_.back() != name) error_ = "unexpected " + name;
            else open_.pop_back();
        } else if (body.back() != '/') {
            open_.push_back(name);
        }
        std::size_t quotes = 0;
        for (char c : body) quotes += c == '"';
        if (quotes % 2 != 0) error_ = "quotes in " + body;
    }

    std::string text_;
    std::size_t at_ = 0;
    std::vector<std::string> open_;
    std::string error_;
};

}  // namespace

TEST_CASE("filters choose test cases by name, wildcard, tag and exclusion", "[cli]") {
    CHECK(names("\"alpha passes\"") == "alpha passes\n");
    CHECK(names("'ALPHA*'") == "alpha passes\n");
    CHECK(names("'*passes'") == "alpha passes\nbeta passes\n");
    CHECK(names("'*a pa*'") == "alpha passes\nbeta passes\n");
    CHECK(names("'[good]'") == "alpha passes\nbeta passes\n");
    CHECK(names("'[good][fast]'") == "alpha passes\n");
    CHECK(names("'[fast],[skip]'") == "alpha passes\nskipped\n");
    CHECK(names("'[good]~[fast]'") == "beta passes\n");
    CHECK(names("'[good]' '~alpha*'") == "beta passes\n");
    CHECK(names("'[good]exclude:alpha*'") == "beta passes\n");
    CHECK(names("'comma\\, bracket \\[x] and \\\"quote\\\"'") == "comma, bracket [x] and \"quote\"\n");
    CHECK(names("'no such test'").empty());
}

TEST_CASE("hidden test cases run only when they are asked for", "[cli]") {
    CHECK(names("").find("hidden") == std::string::npos);
    CHECK(names("'~[good]'").find("hidden") == std::string::npos);
    CHECK(names("'[secret]'") == "hidden\n");
    CHECK(names("hidden") == "hidden\n");
    CHECK(names("'[.]'") == "hidden\nmany failures\naborts\nempty\nslow to shrink\n");
}

TEST_CASE("the exit code is the number of failures, at most 255", "[cli]") {
    CHECK(run_selftest("'[good]'").code == 0);
    CHECK(run_selftest("numbers").code == 5);
    CHECK(run_selftest("'[many]'").code == 255);
    CHECK(run_selftest("'[skip]'").code == 4);
    CHECK(run_selftest("'[skip],[good]'").code == 0);
    CHECK(run_selftest("'expected to fail','may fail'").code == 0);
    CHECK(run_selftest("nothing").code == 0);
    CHECK(run_selftest("nothing --warn NoTests").code == 2);
    CHECK(run_selftest("empty").code == 0);
    CHECK(run_selftest("empty -w NoAssertions").code == 1);
}

TEST_CASE("a wrong command line is refused with its name and exit code 2", "[cli]") {
    for (char const* wrong : {"--no-such-flag", "--rng-seed x", "--order sideways", "-r tap", "-x 0", "--out", "-d maybe"}) {
        CAPTURE(wrong);
        Run const run = run_selftest(wrong);
        CHECK(run.code == 2);
        std::string const flag = std::string(wrong).substr(0, std::string(wrong).find(' '));
        CHECK(run.has("'" + flag + "'"));
    }
    Run const unwritable = run_selftest("-o /no/such/folder/report '[good]'");
    CHECK(unwritable.code == 2);
    CHECK(unwritable.has("/no/such/folder/report"));
}

TEST_CASE("help and lists", "[cli]") {
    CHECK(run_selftest("--help").has("--reporter NAME"));
    CHECK(run_selftest("-?").code == 0);
    Run const tags = run_selftest("--list-tags");
    CHECK(tags.has("2  [good]"));
    CHECK(tags.has("1  [fast]"));
    Run const tests = run_selftest("--list-tests '[good]'");
    CHECK(tests.has("alpha passes"));
    CHECK(tests.has("[good][fast]"));
    CHECK(tests.has("2 test cases"));
}

TEST_CASE("failures show the expression and its values", "[cli]") {
    Run const numbers = run_selftest("numbers");
    CHECK(numbers.has("CHECK( a == 4 )\nwith expansion:\n  3 == 4\n"));
    CHECK(numbers.has("  0.30000000149011613 == 0.3\n"));
    CHECK(numbers.has("  1e+30 < 10.0f\n"));
    CHECK(numbers.has("CHECK_FALSE( a == 3 )\nwith expansion:\n  !(3 == 3)\n"));
    CHECK(numbers.has("  7 == 8\n"));
    CHECK(numbers.has("test cases: 1 | 1 failed\nassertions: 5 | 5 failed\n"));
    Run const things = run_selftest("things");
    for (char const* text : {"\"a\\nb\\\"\" == \"c\"", "'x' == 'y'", "{ 1, 2 } == { }", "5 == 6", "{ 1, true } == { 2, false }",
                             "<1,2> == <3,4>", "1 == 2", "{?} == {?}", "nullptr != nullptr", "1.0f is within 3 ULPs of 2.0f",
                             "\"hay\" ( contains: \"needle\" or starts with: \"x\" )"}) {
        CAPTURE(text);
        CHECK(things.has(std::string("with expansion:\n  ") + text + "\n"));
    }
}

TEST_CASE("REQUIRE stops its test case, exceptions are reported", "[cli]") {
    Run const stop = run_selftest("'require stops'");
    CHECK(stop.code == 1);
    CHECK_FALSE(stop.has("not reached"));
    Run const thrown = run_selftest("exceptions");
    CHECK(thrown.code == 5);
    for (char const* text : {"wrong type", "no exception was thrown", "thrown text", "inside", "escaped"}) CHECK(thrown.has(text));
}

TEST_CASE("messages are shown with the failures in their scope", "[cli]") {
    Run const run = run_selftest("messages");
    CHECK(run.count("info 7 1.5") == 2);
    CHECK(run.count("n := 7\n  n + 1 := 8") == 2);
    CHECK(run.count("once") == 1);
    CHECK_FALSE(run.has("gone"));
}

TEST_CASE("sections run one path at a time, in order", "[cli]") {
    Run const run = run_selftest("sections -r compact");
    std::string seen;
    for (std::size_t at = run.out.find(" for: "); at != std::string::npos; at = run.out.find(" for: ", at + 1)) {
        std::string const word = run.out.substr(at + 6, run.out.find(" in '", at) - at - 6);
        seen += word + " ";
    }
    // As in Catch2, a section in which something failed is looked at once more: that is the fourth "top".
    CHECK(seen == "top a1 top a2 false top top b ");
    CHECK(run_selftest("sections -c b").code == 0);
    CHECK(run_selftest("sections -c a -c a2").has("failed"));
    CHECK_FALSE(run_selftest("sections -c a -c a1").has("a2"));
}

TEST_CASE("-s reports what passes, -a and -x stop early", "[cli]") {
    CHECK(run_selftest("'alpha passes' -s").has("CHECK( 1 + 1 == 2 )\nwith expansion:\n  2 == 2\n"));
    CHECK(run_selftest("numbers -a").code == 1);
    CHECK(run_selftest("numbers -x 3").code == 3);
    CHECK(run_selftest("'[good]' -d yes").has(" s: alpha passes\n"));
}

TEST_CASE("--order rand is a permutation that the seed decides", "[cli]") {
    auto const order = [](std::string const& arguments) { return run_selftest("'[good],[odd]' -r compact -s " + arguments).out; };
    CHECK(order("--order rand --rng-seed 1") == order("--order rand --rng-seed 1"));
    bool differs = false;
    for (int seed = 2; seed < 10; ++seed)
        differs = differs || order("--order rand --rng-seed 1") != order("--order rand --rng-seed " + std::to_string(seed));
    CHECK(differs);
    Run const lexical = run_selftest("'[good]' --order lex -r compact -s");
    CHECK(lexical.out.find("alpha") < lexical.out.find("beta"));
}

TEST_CASE("the junit report is well-formed and counts right", "[cli]") {
    Run const run = run_selftest("'[show],[flow],[xml],[skip],[property]' -r junit");
    CHECK(XmlReader(run.out).complaint() == "");
    CHECK(run.has("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
    CHECK(run.has("skipped=\"1\""));
    CHECK(run.has("&lt;tag attr=\\&quot;&amp;\\&quot;&gt;\\x02"));
    CHECK(run.has("\\x01 \\xff \xc3\xa9 \\xed\\xa0\\x80 ]]&gt;"));
    CHECK(run.count("<testcase ") == run.count("</testcase>") + run.count("\"/>\n    <testcase") + 0u);
    CHECK(XmlReader(run_selftest("'[good]' -r junit").out).complaint() == "");
}

TEST_CASE("-o writes the report into a file", "[cli]") {
    std::string const path = "check_report_" + std::to_string(getpid()) + ".xml";
    CHECK(run_selftest("numbers -r junit -o " + path).code == 5);
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    REQUIRE(file != nullptr);
    std::string text(100000, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file));
    std::fclose(file);
    std::remove(path.c_str());
    CHECK(XmlReader(text).complaint() == "");
    CHECK(text.find("failures=\"5\"") != std::string::npos);
}

TEST_CASE("a crash is reported with the test case that ran", "[cli]") {
    Run const run = run_selftest("aborts -r junit");
    CHECK(run.code != 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    CHECK(run.has("SIGABRT"));
    CHECK(XmlReader(run.out.substr(0, run.out.find("</testsuites>") + 14)).complaint() == "");
#endif
}

TEST_CASE("properties shrink to the smallest counterexample", "[cli][property]") {
    struct Row {
        char const* test;
        char const* arguments;
    };
    for (Row const& row : {Row{"smallest integer", "argument 1: 777\n"}, Row{"smallest negative", "argument 1: -12345\n"},
                           Row{"smallest sum", "argument 1: 0\n    argument 2: 5000\n"},
                           Row{"shortest vector", "argument 1: { 0, 0, 100 }\n"},
                           Row{"shortest unsorted", "argument 1: { 1, 0 }\n"}, Row{"smallest float", "argument 1: 13.0\n"},
                           Row{"shortest string", "argument 1: \"q\"\n"}, Row{"throwing property", "argument 1: 51\n"},
                           Row{"only nan", "argument 1: nan\n"}}) {
        for (int seed = 0; seed < 5; ++seed) {
            Run const run = run_selftest("\"" + std::string(row.test) + "\" --rng-seed " + std::to_string(seed));
            CAPTURE(row.test, seed, run.out);
            CHECK(run.code == 1);
            CHECK(run.has(row.arguments));
        }
    }
}

TEST_CASE("a property is reported once, with its smallest case", "[cli][property]") {
    Run const run = run_selftest("'many checks in one case'");
    CHECK(run.code == 1);
    CHECK(run.count("FAILED:") == 1);
    CHECK(run.has("argument 1: 10\n"));
    CHECK(run.has("v is 10\n"));
    CHECK_FALSE(run.has("v is 11"));
    CHECK(run_selftest("'impossible filter'").has("gave up"));
}

TEST_CASE("the printed command replays the failing case", "[cli][property]") {
    for (int seed = 0; seed < 3; ++seed) {
        Run const first = run_selftest("'shortest vector' --rng-seed " + std::to_string(seed));
        std::string const replay = replay_arguments(first);
        REQUIRE(replay.find("--property-case") != std::string::npos);
        Run const second = run_selftest(replay);
        CHECK(second.out == first.out);
    }
}

TEST_CASE("shrinking ends", "[cli][property]") {
    Run const run = run_selftest("'slow to shrink' -d yes");
    CHECK(run.code == 1);
    CHECK(run.has("argument 1"));
}

TEST_CASE("--property-cases scales all counts", "[cli][property]") {
    CHECK(run_selftest("'smallest integer' --property-cases 10000 -s").code == 1);
    CHECK(run_selftest("'smallest integer' --property-cases x").code == 2);
}
#endif  // POSIX
