// A tev that only listens: takes one connection on a free port of this machine, and puts the image together from the
// protocol's messages.
#pragma once

#include "film/image.h"

#include <arpa/inet.h>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace sundog::test {

class FakeTev {
public:
    enum class Manners { reads, hangs_up, reads_nothing };

    explicit FakeTev(Manners manners) : manners_(manners)
    {
        listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address = {};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 1) != 0 ||
            ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
            throw std::runtime_error("the test cannot listen on 127.0.0.1");
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this] { serve(); });
    }
    ~FakeTev()
    {
        stop();
        ::close(listener_);
    }

    std::string port() const { return std::to_string(port_); }
    std::string address() const { return "127.0.0.1:" + port(); }

    // Waits until the client has gone (or ends a connection that is not read); then these may be looked at.
    void stop()
    {
        stopping_ = true;
        if (thread_.joinable()) thread_.join();
    }
    std::string error; // what is wrong with a message
    std::string name;
    Image image;
    int creations = 0;
    int whole_images = 0; // updates that ended at the last row

private:
    void serve()
    {
        pollfd ready{listener_, POLLIN, 0};
        while (::poll(&ready, 1, 20) == 0)
            if (stopping_ && ::poll(&ready, 1, 0) == 0) return; // nobody came
        const int connection = ::accept(listener_, nullptr, nullptr);
        std::string bytes;
        char some[65536];
        while (manners_ == Manners::reads_nothing && !stopping_) ::usleep(20000);
        if (manners_ == Manners::reads)
            for (ssize_t got; (got = ::read(connection, some, sizeof some)) > 0;) bytes.append(some, static_cast<std::size_t>(got));
        ::close(connection);
        try {
            while (!bytes.empty()) take_message(bytes);
        } catch (const std::exception& wrong) {
            error = wrong.what();
        }
    }

    template <class T> static T take(std::string& bytes)
    {
        if (bytes.size() < sizeof(T)) throw std::runtime_error("a message is too short");
        T value;
        std::memcpy(&value, bytes.data(), sizeof value);
        bytes.erase(0, sizeof value);
        return value;
    }
    static std::string take_text(std::string& bytes)
    {
        const auto end = bytes.find('\0');
        if (end == std::string::npos) throw std::runtime_error("a text does not end");
        std::string text = bytes.substr(0, end);
        bytes.erase(0, end + 1);
        return text;
    }

    void take_message(std::string& bytes)
    {
        std::uint32_t length;
        if (bytes.size() < sizeof length) throw std::runtime_error("bytes after the last message");
        std::memcpy(&length, bytes.data(), sizeof length);
        if (length < 5 || length > bytes.size()) throw std::runtime_error("a message was cut off");
        std::string message = bytes.substr(4, length - 4);
        bytes.erase(0, length);
        const auto operation = take<std::uint8_t>(message);
        const bool focus = take<std::uint8_t>(message) == 1;
        const std::string for_image = take_text(message);
        if (operation == 4) create(message, for_image, focus);
        else if (operation == 6) update(message, for_image);
        else throw std::runtime_error("unknown operation " + std::to_string(operation));
        if (!message.empty()) throw std::runtime_error("a message is too long");
    }

    static std::vector<std::string> take_channels(std::string& message)
    {
        std::vector<std::string> names(static_cast<std::size_t>(take<std::int32_t>(message)));
        for (std::string& channel : names) channel = take_text(message);
        return names;
    }

    void create(std::string& message, const std::string& for_image, bool focus)
    {
        if (!focus) throw std::runtime_error("the new image does not come to the front");
        creations++;
        name = for_image;
        const auto width = take<std::int32_t>(message), height = take<std::int32_t>(message);
        image = Image(width, height, take_channels(message));
    }

    void update(std::string& message, const std::string& for_image)
    {
        if (for_image != name) throw std::runtime_error("update of an image that was not created");
        if (take_channels(message) != image.channels) throw std::runtime_error("update of other channels");
        const auto x = take<std::int32_t>(message), y = take<std::int32_t>(message), width = take<std::int32_t>(message), height = take<std::int32_t>(message);
        std::vector<std::int64_t> offsets(image.channels.size()), strides(image.channels.size());
        for (auto& offset : offsets) offset = take<std::int64_t>(message);
        for (auto& stride : strides) stride = take<std::int64_t>(message);
        const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        std::vector<float> data(pixels * image.channels.size());
        if (message.size() != data.size() * sizeof(float)) throw std::runtime_error("an update has another number of values than pixels");
        std::memcpy(data.data(), message.data(), message.size());
        message.clear();
        for (std::size_t i = 0; i < pixels; i++)
            for (std::size_t c = 0; c < offsets.size(); c++)
                image.at(x + static_cast<int>(i) % width, y + static_cast<int>(i) / width, static_cast<int>(c)) =
                    data.at(static_cast<std::size_t>(offsets[c] + strides[c] * static_cast<std::int64_t>(i)));
        if (y + height == image.height) whole_images++;
    }

    Manners manners_;
    int listener_ = -1;
    std::uint16_t port_ = 0;
    std::atomic<bool> stopping_{false};
    std::thread thread_;
};

} // namespace sundog::test
