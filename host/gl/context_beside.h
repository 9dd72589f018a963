// A second context, for a thread of its own.
#pragma once

#include <memory>

namespace glint {

// Shares textures, programs and samplers with the context that is current on the thread that makes
// it; that one made by make_egl_context. To be made and destroyed there, and current elsewhere.
class ContextBeside {
public:
    ContextBeside();
    ~ContextBeside();
    ContextBeside(const ContextBeside&) = delete;
    ContextBeside& operator=(const ContextBeside&) = delete;

    // Not where there is none to share with, or addresses are rationed.
    bool may_be() const { return beside_ != nullptr; }

    // Makes it the calling thread's context until the result goes; null where the driver has none
    // to give. It begins here, for the driver's work on it takes up to 40 ms.
    struct Current {
        ~Current();
        void* display;
    };
    std::unique_ptr<Current> make_current();

private:
    void* display_ = nullptr;  // EGLDisplay, and EGLContexts
    void* beside_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace glint
