// The image of a running render in a tev viewer. A viewer that cannot be reached, or is lost, costs a warning and
// nothing else.
#pragma once

#include "base/timer.h"
#include "film/tev_viewer.h"
#include "render/session.h"

#include <optional>
#include <string>

namespace sundog {

struct PreviewAddress {
    std::string host;
    std::string port;
    std::string text() const { return host + ":" + port; }
};

class LivePreview {
public:
    LivePreview(const PreviewAddress& address, const std::string& image_name);

    // To be called after every iteration. Shows the image at most once a second, and so that resolving it for this
    // takes at most a tenth of the time; not while the viewer has not yet taken the one before.
    void update(const RenderSession& session);

    // Shows the final image; waits for a viewer that takes it slowly, but not for long.
    void finish(const Image& image);

private:
    void warn();

    std::string address_;
    TevViewer viewer_;
    Timer since_last_;
    double interval_ = 0.0; // s
    bool lost_ = false;
};

} // namespace sundog
