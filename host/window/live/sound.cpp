#include "window/live/sound.h"

#include "window/trial/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

namespace glint {
namespace {

// Where the process would be by itself, within which nothing has to be told; below what an ear
// finds out of step with an eye.
constexpr double kInStep = 0.03;  // s
constexpr double kRest = 300.0;   // ms; that tweaks rest before they are heard

bool is_in_step(const PlayState& told, const PlayState& now) {
    if (told.playing != now.playing || told.rate != now.rate || told.volume != now.volume)
        return false;
    const double moved = told.playing ? (now.at - told.at) * told.rate : 0.0;
    return std::abs(told.time + moved - now.time) < kInStep;
}

}  // namespace

double clock_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

std::vector<std::filesystem::path> sounds_of(const Preset& preset) {
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        if (sampler.source != Source::sound) continue;
        const auto& file = sampler.files.front();
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
    return files;
}

LiveSound::Content LiveSound::content_of(const Preset& preset, std::vector<TweakValue> values) {
    Content content{
        .text = preset.scene.text, .values = std::move(values), .samplers = {}, .files = {}};
    std::error_code error;
    const auto add = [&](const std::filesystem::path& file) {
        content.files.emplace_back(file, std::filesystem::last_write_time(file, error));
    };
    for (const std::filesystem::path& file : sounds_of(preset)) add(file);
    if (!preset.scene.has_sound) return content;
    content.samplers = fmt::format("{}x{}\n", preset.size.x, preset.size.y);  // of buffers
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        content.samplers += sampler_facts(sampler) + '\n';
        for (const std::filesystem::path& file : sampler.files) add(file);
    }
    return content;
}

void LiveSound::follow(const Preset* preset, std::vector<TweakValue> values,
                       const PlayState& state) {
    std::optional<Content> content;
    if (preset) content = content_of(*preset, std::move(values));
    if (content && content->files.empty() && !preset->scene.has_sound) content.reset();
    if (content != content_) {
        if (!content || !content_ || content->text != content_->text) {
            why_silent_.clear();
            is_begun_anew_ = false;
        }
        content_ = std::move(content);
        since_change_.restart();
    }
    if (!content_) return end();
    if (process_.id() == 0 && (state.volume == 0.0f || !why_silent_.empty() || !start())) return;
    SoundOrder order{.scene = {}, .state = state};
    const bool rests = !sent_ || sent_->text != content_->text || since_change_.ms() > kRest;
    if (sent_ != content_ && rests) {
        if (!answered_) {  // it is lost in a loop that never ends
            end();
            if (!start()) return;
        }
        order.scene.push_back(*preset);
        order.scene.back().values = content_->values;
        sent_ = content_;
        answered_ = false;
    }
    if (order.scene.empty() && is_in_step(told_, state)) return;
    told_ = state;
    process_.send(pack(order));
}

bool LiveSound::start() {
    const int error = process_.start("/proc/self/exe", "voice", device_);
    if (error != 0) why_silent_ = std::strerror(error);
    return error == 0;
}

void LiveSound::end() {
    process_.end();
    sent_.reset();
    answered_ = true;
}

bool LiveSound::update() {
    const bool goes_on = process_.receive();
    std::string& arrived = process_.arrived;
    bool is_new = false;
    for (std::size_t at; (at = arrived.find('\n')) != std::string::npos;) {
        const std::string line = arrived.substr(0, at);
        arrived.erase(0, at + 1);
        is_new = answered_ = true;
        why_silent_ = line.starts_with("silent ") ? line.substr(7) : "";
    }
    if (goes_on) return is_new;
    const bool is_unheard = !answered_;
    end();
    // It may have ended before this text came to it, which then deserves another one.
    if (is_unheard && !std::exchange(is_begun_anew_, true)) return true;
    why_silent_ = "the process that plays it has ended";
    return true;
}

}  // namespace glint
