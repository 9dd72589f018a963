// Where the program's memory is: in pages of 2 MB, of which the system gives 500 times fewer.
//
// Half of a short run of llvmpipe's compilers was the system's, that gave pages of 4 KB. glibc
// takes large ones only by an environment variable that was there before the program began;
// mimalloc (Leijen, Zorn, de Moura 2019) takes a room that is prepared here, before any library
// asks for memory, and asks the system for more when it is full.
#include <mimalloc.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace {

// A room that is not used takes no memory. Every thread that allocates begins a part of 32 MB.
constexpr std::size_t kRoom = std::size_t{512} << 20;
constexpr std::size_t kAlignment = std::size_t{64} << 20;

void prepare_room() {
    void* const taken = ::mmap(nullptr, kRoom + kAlignment, PROT_READ | PROT_WRITE,
                               MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (taken == MAP_FAILED) return;
    const auto start =
        (reinterpret_cast<std::uintptr_t>(taken) + kAlignment - 1) & ~(kAlignment - 1);
    void* const room = reinterpret_cast<void*>(start);
    ::madvise(room, kRoom, MADV_HUGEPAGE);       // a system without them keeps to small ones
    mi_option_set(mi_option_allow_decommit, 0);  // a page that was given back comes back small
    mi_manage_os_memory(room, kRoom, true, false, true, -1);
}

// Runs before the constructors of the libraries.
__attribute__((section(".preinit_array"), used)) void (*const kPrepareRoom)() = prepare_room;

}  // namespace
