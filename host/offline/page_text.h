// The web page that draws a plan: host/offline/page/, put together by CMake.
#pragma once

#include <string_view>

namespace glint {

// <!--TITLE--> and /*PLAN*/ stand where these belong.
std::string_view page_text();

}  // namespace glint
