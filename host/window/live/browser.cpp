#include "window/live/browser.h"

#include "base/hash.h"
#include "base/launch.h"
#include "offline/examples.h"
#include "scene/passes.h"
#include "window/live/preview.h"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr const char* kThumbnailSize = "192x108";
// s, of all its threads. A scene that never comes to an end must not hold up those behind it.
constexpr rlim_t kMostProcessorTime = 60;

// Of all thumbnails; some hundreds.
constexpr std::uintmax_t kMostThumbnailBytes = std::uintmax_t{16} << 20;

// A file that is there twice, through a link, is listed once.
void append_files(std::vector<fs::path>& list, std::set<fs::path>& known, const fs::path& folder,
                  const char* extension) {
    std::error_code error;
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (entry.path().extension() == extension) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    for (const fs::path& file : found) {
        const fs::path place = fs::weakly_canonical(file, error);
        if (known.insert(error ? file : place).second) list.push_back(file);
    }
}

// A scene has its ending, which tells it from the preset of its name.
std::string shown_name(const fs::path& file) {
    return (is_preset(file) ? file.stem() : file.filename()).string();
}

// Lowest priority, and silent: a scene that does not compile, or does not end, simply has no
// thumbnail. It ends with the window.
int start_still(const fs::path& file, const fs::path& output) {
    std::vector<std::string> words = {"/proc/self/exe", "still",  file.string(), "-o",
                                      output.string(),  "--size", kThumbnailSize};
    const int process = launch({.words = std::move(words), .niceness = 19}).process;
    const rlimit limit = {.rlim_cur = kMostProcessorTime, .rlim_max = kMostProcessorTime};
    if (process != 0) prlimit(process, RLIMIT_CPU, &limit, nullptr);
    return process;
}

Texture make_thumbnail(const Image& image) {
    const bool rgba = image.channels == 4;
    if (image.type != ChannelType::u8 || image.channels < 3) return {};
    Texture texture = make_texture_2d(GL_RGBA8, image.size);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.id(), 0, 0, 0, image.size.x, image.size.y, rgba ? GL_RGBA : GL_RGB,
                        GL_UNSIGNED_BYTE, image.pixels.data());
    return texture;
}

}  // namespace

std::vector<fs::path> nearby_files(const fs::path& file) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    std::vector<fs::path> list;
    std::set<fs::path> known;
    for (const fs::path& place : {folder, folder / ".." / "presets"})
        append_files(list, known, place, ".toml");
    for (const fs::path& place : {folder, folder / ".." / "fragments"})
        append_files(list, known, place, ".frag");
    return list;
}

std::string thumbnail_name(const fs::path& file) {
    const ReadPreset read = read_preset(file);
    std::vector<fs::path> files = read.files;
    for (std::size_t i = 0; read.preset && i < sampler_count(*read.preset); ++i) {
        const Sampler& sampler = sampler_at(*read.preset, i);
        files.insert(files.end(), sampler.files.begin(), sampler.files.end());
    }
    Hash digest;
    for (const fs::path& each : files) {
        std::error_code error;
        digest.add(fs::absolute(each, error).string());
        digest.add(fmt::format("{}", fs::last_write_time(each, error).time_since_epoch().count()));
    }
    return digest.text() + ".png";
}

Browser::Browser(fs::path cache) : cache_(std::move(cache), kMostThumbnailBytes) {}

Browser::~Browser() {
    if (rendering_ == 0) return;
    kill(rendering_, SIGKILL);
    wait_for(rendering_);
}

void Browser::list(const std::vector<Shelf>& shelves) {
    names_.clear();
    std::vector<Look> looks;
    for (const Shelf& shelf : shelves) {
        for (const fs::path& file : shelf.files) {
            looks.push_back(
                {.file = file, .shelf = shelf.heading, .title = shown_name(file), .thumbnail = {}});
            for (Look& known : looks_) {
                if (known.file != file || known.shelf != shelf.heading) continue;
                looks.back().is_done = static_cast<bool>(known.thumbnail);
                looks.back().thumbnail = std::move(known.thumbnail);
            }
        }
    }
    looks_ = std::move(looks);
}

// The picture that lies ready for a file; empty where it has to be drawn.
fs::path Browser::ready_picture(const fs::path& file, const std::string& name) const {
    const fs::path drawn = place_of(name);
    std::error_code error;
    return fs::exists(drawn, error) ? drawn : gallery_picture(file);
}

// In view before the rest, and what lies ready before what has to be drawn; each from top to
// bottom.
const Look* Browser::next() const {
    const Look* best = nullptr;
    int best_rank = 0;
    for (const Look& look : looks_) {
        if (look.is_done) continue;
        const bool is_seen = std::ranges::find(first_, look.file) != first_.end();
        // What is not known yet is looked at first.
        const auto name = names_.find(look.file);
        const bool is_ready =
            name == names_.end() || !ready_picture(look.file, name->second).empty();
        const int rank = (is_seen ? 2 : 0) + (is_ready ? 1 : 0) + 1;
        if (rank <= best_rank) continue;
        best = &look;
        best_rank = rank;
        if (is_seen && is_ready) break;
    }
    return best;
}

// A name asks for all that is read for a scene: only those are asked for that may be next.
const Look* Browser::next_of_known_name() {
    const Look* look = next();
    for (; look && !names_.contains(look->file); look = next())
        names_[look->file] = thumbnail_name(look->file);
    return look;
}

void Browser::start_next() {
    const Look* look = next_of_known_name();
    if (!look) return;
    current_ = look->file;
    const std::string& name = names_.at(current_);
    const fs::path picture = ready_picture(current_, name);
    if (!picture.empty()) {
        reading_ = std::async(std::launch::async, [picture] { return read_preview(picture); });
        return;
    }
    std::error_code error;
    fs::create_directories(cache_.folder(), error);
    rendering_ = start_still(current_, place_of(name));
    if (rendering_ == 0) finish({});
}

// A file may stand on two shelves: one of them has it now, and the other's turn comes.
void Browser::finish(Texture thumbnail) {
    for (Look& look : looks_) {
        if (look.file != current_ || look.is_done) continue;
        look.thumbnail = std::move(thumbnail);
        look.is_done = true;
        return;
    }
}

bool Browser::update(bool is_shown) {
    if (rendering_ != 0) {
        const std::optional<int> code = ended(rendering_);
        if (!code) return false;
        rendering_ = 0;
        if (*code != 0) finish({});  // no picture of this one
        cache_.forget_oldest();
        return false;
    }
    if (!reading_.valid()) {
        if (is_shown) start_next();
        return false;
    }
    if (reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    try {
        finish(make_thumbnail(reading_.get()));
    } catch (const std::exception&) {
        finish({});  // a broken cache entry: left out
    }
    return true;
}

}  // namespace glint
