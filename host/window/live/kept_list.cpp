#include "window/live/kept_list.h"

#include "base/readable_file.h"
#include "base/temporary_file.h"

#include <span>
#include <sstream>
#include <stdexcept>

namespace glint {

constexpr std::size_t kLongestList = 1 << 18;  // bytes

std::vector<std::string> KeptList::lines() const {
    std::vector<std::string> list;
    try {
        std::istringstream text(read_whole_file(file_, kLongestList));
        for (std::string line; std::getline(text, line) && list.size() < most_;)
            if (!line.empty()) list.push_back(line);
    } catch (const Unreadable&) {
        return {};
    }
    return list;
}

void KeptList::put_first(const std::string& line,
                         const std::function<bool(const std::string&)>& is_replaced) const {
    if (line.find('\n') != std::string::npos) return;
    std::vector<std::string> list = lines();
    std::erase_if(list, is_replaced);
    list.insert(list.begin(), line);
    list.resize(std::min(list.size(), most_));
    std::string text;
    for (const std::string& each : list) text += each + "\n";
    try {
        make_folder(file_.parent_path());
        write_whole_file(file_, std::as_bytes(std::span(text)));
    } catch (const std::runtime_error&) {
        // A disk that is full or not ours.
    }
}

}  // namespace glint
