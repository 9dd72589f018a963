#include "offline/named_files.h"

#include "base/canonical_name.h"
#include "base/numbered_name.h"
#include "offline/common.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

// Two names of one file have the same, once it is there.
using FileNumber = std::pair<dev_t, ino_t>;

std::optional<FileNumber> file_number(const fs::path& name) {
    struct stat facts {};
    if (::stat(name.c_str(), &facts) != 0) return std::nullopt;
    return FileNumber{facts.st_dev, facts.st_ino};
}

bool are_digits(std::string_view text) {
    return std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// A NamedFile, looked up.
struct Resolved {
    explicit Resolved(const NamedFile& file) : named(file), numbered(numbered_name(file.name)) {
        if (!numbered) {
            place = canonical_name(file.name);
            if (const auto number = file_number(place)) there.push_back(*number);
            return;
        }
        const fs::path before = numbered->before;
        const fs::path folder = before.has_parent_path() ? before.parent_path() : ".";
        numbered->before = (canonical_name(folder) / before.filename()).string();
        for (const int k : numbered->numbers_there()) {
            if (k < file.first || k > file.last) continue;
            if (const auto number = file_number(numbered->name(k))) there.push_back(*number);
        }
        std::ranges::sort(there);
    }

    // Whether a plain name is one of these.
    bool stands_for(const fs::path& plain) const {
        const std::string& text = plain.native();
        if (text.size() < numbered->before.size()) return false;
        int number = -1;
        std::from_chars(text.data() + numbered->before.size(), text.data() + text.size(), number);
        return number >= named.first && number <= named.last && numbered->name(number) == plain;
    }

    const NamedFile& named;
    std::optional<NumberedName> numbered;
    fs::path place{};                 // of a plain name
    std::vector<FileNumber> there{};  // sorted
};

// "a%d.exr" and "a1%d.exr" both stand for a12.exr.
bool may_meet(const NumberedName& a, const NumberedName& b) {
    const auto [shorter, longer] = std::minmax(
        a.before, b.before, [](const auto& x, const auto& y) { return x.size() < y.size(); });
    const auto [short_end, long_end] = std::minmax(
        a.after, b.after, [](const auto& x, const auto& y) { return x.size() < y.size(); });
    return longer.starts_with(shorter) && long_end.ends_with(short_end) &&
           are_digits(std::string_view(longer).substr(shorter.size())) &&
           are_digits(std::string_view(long_end).substr(0, long_end.size() - short_end.size()));
}

bool are_one(const Resolved& a, const Resolved& b) {
    std::vector<FileNumber> shared;
    std::ranges::set_intersection(a.there, b.there, std::back_inserter(shared));
    if (!shared.empty()) return true;
    if (a.numbered && b.numbered) return may_meet(*a.numbered, *b.numbered);
    if (a.numbered) return a.stands_for(b.place);
    if (b.numbered) return b.stands_for(a.place);
    return a.place == b.place;
}

std::vector<Resolved> resolved(const std::vector<NamedFile>& files) {
    std::vector<Resolved> list;
    for (const NamedFile& file : files)
        if (!file.name.empty()) list.emplace_back(file);
    return list;
}

}  // namespace

std::vector<NamedFile> files_read_for(const Preset& preset) {
    std::vector<NamedFile> files = {{"the file that is opened", preset.file.string()}};
    for (const fs::path& file : preset.scene.files) files.push_back({"the scene", file.string()});
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        const Sampler& sampler = sampler_at(preset, i);
        for (const fs::path& file : sampler.files)
            files.push_back({"what " + sampler.name + " reads", file.string()});
    }
    return files;
}

std::vector<NamedFile> files_expected(const Preset& preset) {
    return {{"the expected picture", preset.expect.picture.string()},
            {"the look that times are held against", preset.expect.ms_of.string()}};
}

void require_apart(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    const std::vector<Resolved> written = resolved(outputs), read = resolved(inputs);
    for (std::size_t i = 0; i < written.size(); ++i) {
        const NamedFile& output = written[i].named;
        for (std::size_t k = i + 1; k < written.size(); ++k) {
            if (!are_one(written[i], written[k])) continue;
            throw UsageError(fmt::format(
                "{} {} and {} {} are one file; give them names of their own.", output.role,
                output.name, written[k].named.role, written[k].named.name));
        }
        for (const Resolved& input : read) {
            if (!are_one(written[i], input)) continue;
            throw UsageError(fmt::format("{} {} would replace {}, {}; name another file.",
                                         output.role, output.name, input.named.role,
                                         input.named.name));
        }
    }
}

void require_folder(const fs::path& output) {
    std::error_code unknown;
    if (output == "-") throw UsageError("-o -: these are several files; name a folder.");
    if (fs::exists(output, unknown) && !fs::is_directory(output, unknown))
        throw UsageError(fmt::format("-o {}: this is a file; name a folder.", output.string()));
}

}  // namespace glint
