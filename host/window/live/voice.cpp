#include "window/live/voice.h"

#include "gl/context.h"
#include "media/feed.h"
#include "offline/sound.h"
#include "window/live/sound.h"
#include "window/live/speaker.h"
#include "window/trial/message.h"
#include "window/trial/socket_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

namespace glint {
namespace {

static_assert(kFeedBlock == long{kSoundBlockWidth} * kSoundBlockRows);

void tell(const std::string& line) {
    const std::string text = line + "\n";
    if (::send(STDIN_FILENO, text.data(), text.size(), MSG_NOSIGNAL) <= 0) _exit(0);
}

// What one scene sounds like: its mainSound, and the files that it listens to.
class Sources {
public:
    Sources(Preset preset, const std::string& device, std::unique_ptr<Context>& context)
        : preset_(std::move(preset)) {
        for (const std::filesystem::path& file : sounds_of(preset_))
            files_.push_back(read_sound(file));
        if (!preset_.scene.has_sound) return;
        if (!context) context = make_egl_context(device);
        renderer_.emplace(preset_, ProgramOptions{});
    }

    std::vector<float> block(long index) {
        std::vector<float> pairs =
            renderer_ ? renderer_->block(index) : std::vector<float>(2 * kFeedBlock, 0.0f);
        for (const Sound& file : files_) {
            for (long i = 0; i < kFeedBlock; ++i) {
                const long sample = (index * kFeedBlock + i) % file.count();  // again and again
                for (long side = 0; side < 2; ++side)
                    pairs[static_cast<std::size_t>(2 * i + side)] +=
                        static_cast<float>(
                            file.samples[static_cast<std::size_t>(2 * sample + side)]) /
                        32768.0f;
            }
        }
        return pairs;
    }

private:
    Preset preset_;
    std::vector<Sound> files_;
    std::optional<SoundRenderer> renderer_;
};

// One thread makes blocks and listens to the window, another one writes to the device.
class Voice {
public:
    explicit Voice(const std::string& device) : device_(device) {}
    [[noreturn]] void run();

private:
    void hear();
    void obey(SoundOrder order);
    void take(Preset scene);
    void forget_gone_speaker();
    bool make_block();
    void play();

    std::string device_;
    std::unique_ptr<Context> context_;
    std::unique_ptr<Sources> sources_;
    bool is_new_ = false;  // nothing of the sources is in the feed yet
    std::string arrived_;
    std::unique_ptr<Speaker> speaker_;
    std::thread player_;

    std::mutex mutex_;  // of what follows
    std::condition_variable wake_;
    SoundFeed feed_;
    bool is_gone_ = false;  // the device of the speaker; the player has ended
};

void Voice::run() {
    for (;;) {
        const bool busy = sources_ && make_block();
        // The next block is due in a while; the window's orders come when they come.
        pollfd socket{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
        const bool plays = [&] {
            const std::scoped_lock lock(mutex_);
            return !feed_.is_silent();
        }();
        if (::poll(&socket, 1, busy ? 0 : plays ? 50 : -1) > 0) hear();
    }
}

void Voice::hear() {
    std::array<char, 64 * 1024> buffer;
    const ssize_t length = ::recv(STDIN_FILENO, buffer.data(), buffer.size(), 0);
    if (length <= 0) _exit(0);  // the window is gone
    arrived_.append(buffer.data(), static_cast<std::size_t>(length));
    while (const auto message = take_message(arrived_)) obey(unpack_sound_order(*message));
}

void Voice::obey(SoundOrder order) {
    if (!order.scene.empty()) take(std::move(order.scene.front()));
    const std::scoped_lock lock(mutex_);
    if (!sources_ || !speaker_) order.state.playing = false;
    feed_.follow(order.state);
    wake_.notify_one();
}

void Voice::take(Preset scene) {
    forget_gone_speaker();
    try {
        if (!speaker_) speaker_ = std::make_unique<Speaker>();
        if (!player_.joinable()) player_ = std::thread([this] { play(); });
        sources_.reset();
        sources_ = std::make_unique<Sources>(std::move(scene), device_, context_);
        is_new_ = true;
    } catch (const Stop&) {
        tell("silent mainSound does not compile; see the errors");
    } catch (const std::exception& error) {
        tell(fmt::format("silent {}", error.what()));
    }
}

// There may be a device again by now.
void Voice::forget_gone_speaker() {
    {
        const std::scoped_lock lock(mutex_);
        if (!std::exchange(is_gone_, false)) return;
    }
    player_.join();
    speaker_.reset();
}

// What was made of the sources before sounds until the first block of the new ones is there.
bool Voice::make_block() {
    std::optional<long> wanted;
    {
        const std::scoped_lock lock(mutex_);
        wanted = is_new_ ? feed_.block_at(clock_seconds()) : feed_.wanted_block(clock_seconds());
    }
    if (!wanted) return false;
    std::vector<float> pairs = sources_->block(*wanted);
    const std::scoped_lock lock(mutex_);
    if (is_new_) {
        feed_.clear();
        tell("plays");
    }
    is_new_ = false;
    feed_.add(*wanted, std::move(pairs));
    return true;
}

// The device is asked for nothing while nothing sounds.
void Voice::play() {
    constexpr std::size_t kChunk = 512;  // samples
    constexpr double kAhead = 0.1;       // s; a device that takes all at once is held back to that
    std::array<float, 2 * kChunk> pairs{};
    for (;;) {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return !feed_.is_silent(); });
        lock.unlock();
        bool works = speaker_->start();
        const double latency = speaker_->latency(), begin = clock_seconds();
        for (long written = 0; works; written += kChunk) {
            const double early = begin + static_cast<double>(written) / kSoundRate -
                                 clock_seconds() - latency - kAhead;
            if (early > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(early));
            lock.lock();
            const bool ends = feed_.is_silent();
            feed_.fill(pairs, clock_seconds() + latency);
            lock.unlock();
            if (ends) break;
            works = speaker_->write(pairs);
        }
        speaker_->stop();
        if (works) continue;
        tell("silent the sound device is gone");
        lock.lock();
        is_gone_ = true;
        return;
    }
}

}  // namespace

void run_voice(const std::string& device) {
    require_socket("voice");
    ::setenv("JACK_NO_START_SERVER", "1", 1);
    Voice(device).run();
}

}  // namespace glint
