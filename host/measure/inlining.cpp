// SPIR-V is that of glslang; spirv-opt takes away what is never reached. Copies are counted, not
// made.
#include "measure/inlining.h"

#include "base/launch.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"
#include "base/temporary_folder.h"
#include "render/compile_watch.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <span>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::uint32_t>;

constexpr std::size_t kLargestModule = 256u << 20;  // bytes
constexpr std::size_t kHeader = 5;                  // words

// SPIR-V 1.6, section 3.49.
enum Op : std::uint32_t {
    kName = 5,
    kEntryPoint = 15,
    kFunction = 54,
    kFunctionEnd = 56,
    kFunctionCall = 57,
};

struct Routine {  // a function of a module
    std::string name;
    std::size_t own_words = 0;
    std::map<std::uint32_t, std::size_t> calls;  // call sites, by whom they call
};

struct Module {
    std::map<std::uint32_t, Routine> functions;
    std::uint32_t entry = 0;
};

// Literal strings end with a zero byte within the instruction.
std::string literal(std::span<const std::uint32_t> words) {
    std::string text(words.size_bytes(), '\0');
    std::memcpy(text.data(), words.data(), text.size());
    return text.substr(0, text.find('\0'));
}

Module parse(const Words& words) {
    Module module;
    std::map<std::uint32_t, std::string> names;
    Routine* inside = nullptr;
    for (std::size_t at = kHeader; at < words.size();) {
        const std::size_t count = words[at] >> 16;
        if (count == 0 || count > words.size() - at) break;
        const std::span instruction(words.data() + at, count);
        const std::uint32_t op = words[at] & 0xffffu;
        if (op == kName && count > 2) names[instruction[1]] = literal(instruction.subspan(2));
        if (op == kEntryPoint && count > 2) module.entry = instruction[2];
        if (op == kFunction && count > 2) inside = &module.functions[instruction[2]];
        if (op == kFunctionCall && inside && count > 3) ++inside->calls[instruction[3]];
        if (inside) inside->own_words += count;
        if (op == kFunctionEnd) inside = nullptr;
        at += count;
    }
    // glslang writes the types of the parameters behind a name: "map(vf3;".
    for (auto& [id, function] : module.functions)
        function.name = names[id].substr(0, names[id].find('('));
    return module;
}

// GLSL knows no recursion, so both walks end; each result is kept, so that they end soon.
class Inlining {
public:
    explicit Inlining(const Module& module) : module_(module) {}

    std::size_t words(std::uint32_t id) {
        if (const auto known = words_.find(id); known != words_.end()) return known->second;
        const Routine& function = module_.functions.at(id);
        std::size_t sum = function.own_words;
        for (const auto& [callee, sites] : function.calls) sum += sites * words(callee);
        return words_[id] = sum;
    }

    std::size_t copies(std::uint32_t id) {
        if (id == module_.entry) return 1;
        if (const auto known = copies_.find(id); known != copies_.end()) return known->second;
        std::size_t sum = 0;
        for (const auto& [caller, function] : module_.functions)
            if (const auto sites = function.calls.find(id); sites != function.calls.end())
                sum += sites->second * copies(caller);
        return copies_[id] = sum;
    }

private:
    const Module& module_;
    std::map<std::uint32_t, std::size_t> words_, copies_;
};

// Of texts; one that calls itself is none of GLSL, and counts once.
class TextInlining {
public:
    explicit TextInlining(const Reading& reading)
        : reading_(reading), calls_(reading.functions.size()), tokens_(reading.functions.size()) {
        for (const Call& call : reading.calls)
            if (call.function != kNone) calls_[call.function].push_back(&call);
        for (std::uint32_t i = 0; i < reading.functions.size(); ++i)
            if (const Function& function = reading.functions[i]; function.is_defined())
                defined_[{reading.word(function.name), function.parameters.size()}] = i;
    }

    double tokens(std::uint32_t function, int depth) {
        constexpr int kDeepest = 500;
        if (tokens_[function] > 0.0 || depth > kDeepest) return tokens_[function];
        double sum = tokens_[function] = reading_.functions[function].tokens.size();
        for (const Call* call : calls_[function])
            if (const auto one = defined_.find({reading_.word(call->name), call->arity});
                one != defined_.end())
                sum += tokens(one->second, depth + 1);
        return tokens_[function] = sum;
    }

private:
    const Reading& reading_;
    std::vector<std::vector<const Call*>> calls_;  // by function
    std::vector<double> tokens_;
    std::map<std::pair<std::string_view, std::size_t>, std::uint32_t> defined_;
};

// False where the program is not there or refuses; its words on that are of no use to a person.
bool runs(std::vector<std::string> words) {
    const CompileLimits limits = compile_limits();
    const Launched launched = launch({.words = std::move(words),
                                      .core_files = false,
                                      .most_seconds = static_cast<rlim_t>(limits.seconds),
                                      .most_bytes = limits.bytes});
    return launched.process != 0 && wait_for(launched.process) == 0;
}

Words read_module(const fs::path& file) {
    const std::string bytes = read_whole_file(file, kLargestModule);
    Words words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

// SPIR-V is made of GLSL ES 3.10 and later, which has a few words more.
std::string as_310(std::string_view text) {
    constexpr std::string_view kOurs = "#version 300 es\n";
    std::string later(text);
    if (text.starts_with(kOurs))
        later.replace(0, kOurs.size(),
                      "#version 310 es\n#define buffer buffer_\n#define shared shared_\n"
                      "#define precise precise_\n");
    return later;
}

}  // namespace

ProgramSize inlined_size(const Words& words) {
    const Module module = parse(words);
    Inlining inlining(module);
    ProgramSize size;
    for (const auto& [id, function] : module.functions) {
        const std::size_t copies = inlining.copies(id);
        size.words += copies * function.own_words;
        if (id != module.entry && copies > 0)
            size.functions.push_back({function.name, copies, inlining.words(id)});
    }
    std::ranges::stable_sort(size.functions, std::greater(), &InlinedFunction::saved_by_one_call);
    return size;
}

double inlined_tokens(const Reading& reading, std::string_view entry) {
    TextInlining inlining(reading);
    double sum = 0.0;
    for (const std::uint32_t function : reading.functions_named(entry))
        sum += inlining.tokens(function, 0);
    return sum;
}

std::optional<ProgramSize> program_size(std::string_view text, std::string& why_not) try {
    const TemporaryFolder folder;  // for each call; several threads may be here
    const auto file = [&](const char* name) { return (folder.path() / name).string(); };
    const std::string later = as_310(text);
    write_whole_file(file("pass.frag"), std::as_bytes(std::span(later)));
    // Relaxed rules let uniforms stand outside of blocks; nothing is ever drawn by this module.
    if (!runs({"glslangValidator", "-V", "-R", "--aml", "--amb", "-o", file("all.spv"),
               file("pass.frag")})) {
        why_not = "glslangValidator is not installed, or does not take the text, or not in time";
        return std::nullopt;
    }
    if (!runs({"spirv-opt", "--eliminate-dead-branches", "--merge-return",
               "--eliminate-dead-functions", file("all.spv"), "-o", file("reached.spv")})) {
        why_not = "spirv-opt is not installed, or took too long";
        return std::nullopt;
    }
    return inlined_size(read_module(file("reached.spv")));
} catch (const std::runtime_error& error) {  // no room, or no place, for files
    why_not = error.what();
    return std::nullopt;
}

}  // namespace glint
