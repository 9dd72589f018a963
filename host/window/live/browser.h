// The scenes and presets near the open file, with thumbnails that another process renders and a
// cache keeps.
#pragma once

#include "gl/objects.h"
#include "media/image.h"
#include "window/live/kept_files.h"

#include <filesystem>
#include <future>
#include <map>
#include <string>
#include <vector>

namespace glint {

struct Look {
    std::filesystem::path file;
    std::string shelf;  // as BrowserEntry::shelf
    std::string title;
    Texture thumbnail;     // empty until it is there
    bool is_done = false;  // it is there, or there will be none
};

// The presets and scenes in the folder of `file`, and in fragments/ and presets/ beside that
// folder; presets first, by name. A folder that cannot be read counts as empty.
std::vector<std::filesystem::path> nearby_files(const std::filesystem::path& file);

// Of the thumbnail of a preset or a scene, which is read for it: another one once anything has
// changed that it is drawn from.
std::string thumbnail_name(const std::filesystem::path& file);

class Browser {
public:
    // Thumbnails lie in the folder `cache`; where it cannot be written, there are none. A GL
    // context is current as long as this lives.
    explicit Browser(std::filesystem::path cache);
    ~Browser();  // ends the process that draws
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    // In this order, under these headings.
    struct Shelf {
        std::string heading;
        std::vector<std::filesystem::path> files;
    };
    void list(const std::vector<Shelf>& shelves);

    // Those in view come before the others.
    void draw_first(const std::vector<std::filesystem::path>& files) { first_ = files; }

    // One thumbnail at a time, at the lowest priority, and none begun unless the browser
    // `is_shown`; does not wait. True when one has arrived.
    bool update(bool is_shown);

    // Whether a thumbnail is being made.
    bool is_busy() const { return rendering_ != 0 || reading_.valid(); }

    // In the order of nearby_files(); valid until the next list() or update().
    const std::vector<Look>& looks() const { return looks_; }

private:
    const Look* next() const;
    const Look* next_of_known_name();
    void start_next();
    void finish(Texture thumbnail);
    std::filesystem::path place_of(const std::string& name) const { return cache_.folder() / name; }
    std::filesystem::path ready_picture(const std::filesystem::path& file,
                                        const std::string& name) const;

    KeptFiles cache_;
    std::vector<Look> looks_;
    std::map<std::filesystem::path, std::string> names_;  // of thumbnails, as far as they are known
    std::vector<std::filesystem::path> first_;            // in view
    std::filesystem::path current_;                       // whose thumbnail is drawn or read
    int rendering_ = 0;                                   // the process that draws it
    std::future<Image> reading_;
};

}  // namespace glint
