#include "base/numbered_name.h"

#include "base/temporary_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

namespace glint {

namespace fs = std::filesystem;

fs::path NumberedName::name(int number) const {
    return fmt::format("{}{:0{}}{}", before, number, digits, after);
}

std::vector<int> NumberedName::numbers_there() const {
    std::vector<int> numbers;
    const fs::path folder = name(0).parent_path();
    const std::string start = fs::path(before).filename().string();
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end;
         !error && entry != end; entry.increment(error)) {
        const std::string file = entry->path().filename().string();
        if (!file.starts_with(start)) continue;
        int number = -1;
        std::from_chars(file.data() + start.size(), file.data() + file.size(), number);
        if (number >= 0 && name(number).filename() == file) numbers.push_back(number);
    }
    std::ranges::sort(numbers);
    return numbers;
}

std::optional<NumberedName> numbered_name(const std::string& text) {
    const std::size_t percent = text.find('%', text.rfind('/') + 1);  // 0 where there is none
    const std::size_t d = text.find('d', percent);
    if (percent == std::string::npos || d == std::string::npos) return std::nullopt;
    const std::string digits = text.substr(percent + 1, d - percent - 1);
    const bool is_plain = digits.size() <= 3 && std::ranges::all_of(digits, [](unsigned char c) {
                              return std::isdigit(c) != 0;
                          });
    if (!is_plain || text.find('%', d) != std::string::npos) return std::nullopt;
    return NumberedName{.before = text.substr(0, percent),
                        .after = text.substr(d + 1),
                        .digits = digits.empty() ? 0 : std::stoi(digits)};
}

std::filesystem::path free_picture_name(const std::filesystem::path& file) {
    for (int number = 1;; ++number) {
        const std::filesystem::path name =
            fmt::format("{}-{:04}.png", file.stem().string(), number);
        // One that cannot even be asked for is refused, with the reason, where it is written.
        if (!is_taken(name)) return name;
    }
}

}  // namespace glint
