// Images to a running tev (https://github.com/Tom94/tev) through its TCP protocol. All that can block - resolving the
// name, connecting, a viewer that does not read - happens in a thread of its own.
#pragma once

#include "film/image.h"

#include <memory>
#include <optional>
#include <string>

namespace sundog {

class TevViewer {
public:
    // Starts to connect. port: a number in decimal; tev's own default is 14158. image_name is what tev lists.
    TevViewer(std::string host, std::string port, std::string image_name);
    TevViewer(const TevViewer&) = delete;
    TevViewer& operator=(const TevViewer&) = delete;
    ~TevViewer(); // without finish(): what has not been sent yet is dropped

    // Copies R, G and B and returns at once; an image that still waits to be sent is replaced. All images of a
    // viewer must have one size.
    void show(const Image& image);

    // An image still waits or is on its way: another one would come too early.
    bool busy() const;

    // Waits until all is sent, at most so many seconds; then closes the connection.
    void finish(double seconds);

    // What went wrong, once; from then on images are dropped.
    std::optional<std::string> take_problem();

private:
    struct Link;
    std::shared_ptr<Link> link_;
};

} // namespace sundog
