#include "window/live/kept_verdicts.h"

#include "base/hash.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"
#include "scene/passes.h"
#include "window/trial/message.h"

#include <fmt/format.h>

#include <exception>
#include <span>
#include <system_error>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostVerdictBytes = std::size_t{64} << 10;  // some hundred passes

// The time and the inputs' pixels are of no account to a trial.
std::string digest_of(const Candidate& candidate, const std::string& driver) {
    const Preset& preset = candidate.preset;
    Hash digest;
    digest.add(driver);
    digest.add(preset.file.string());
    digest.add(preset.scene.text);
    for (std::size_t i = 0; i < preset.values.size(); ++i)
        digest.add(format_value(preset.scene.tweaks[i], preset.values[i]));
    for (const Sampler& channel : preset.channels) {
        digest.add(sampler_facts(channel));
        for (const fs::path& file : channel.files) digest.add(file.string());
    }
    digest.add(fmt::format("{}x{} {}", candidate.size.x, candidate.size.y,
                           candidate.compile.program.specialise));
    return digest.text();
}

}  // namespace

std::optional<Verdict> KeptVerdicts::take(const Candidate& candidate) {
    if (files_.folder().empty()) return std::nullopt;
    name_ = digest_of(candidate, driver_);
    const fs::path file = files_.folder() / name_;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    try {
        std::string kept = read_whole_file(file, kMostVerdictBytes);
        fs::remove(file);
        const auto message = take_message(kept);
        if (!message) return std::nullopt;
        Verdict verdict = unpack_answer(*message).verdict;
        verdict.total_ms = 0.0;
        return verdict;
    } catch (const std::exception&) {
        // Not whole, not ours, or not to be removed: it is tried.
    }
    return std::nullopt;
}

void KeptVerdicts::keep(const Verdict& verdict) {
    const std::string name = std::exchange(name_, {});
    if (name.empty() || verdict.state != TrialState::passed) return;
    TrialAnswer answer;
    answer.verdict = verdict;
    files_.keep(name, [message = pack(answer)](const fs::path& file) {
        write_whole_file(file, std::as_bytes(std::span(message)));
    });
}

}  // namespace glint
