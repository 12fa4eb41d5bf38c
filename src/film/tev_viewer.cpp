// The protocol, of which this is a part: a message is a uint32 with its own length in bytes, these four included, a
// byte that says what it asks for, and that operation's fields; numbers are little endian, texts end with a zero
// byte. https://github.com/Tom94/tev, "Over the Network".
#include "film/tev_viewer.h"

#include "base/timer.h"
#include "film/image_codec.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <fcntl.h>
#include <mutex>
#include <netdb.h>
#include <poll.h>
#include <stdexcept>
#include <string_view>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace sundog {

namespace {

static_assert(std::endian::native == std::endian::little, "the protocol's byte order");

constexpr double connect_seconds = 5.0;
constexpr double stall_seconds = 10.0; // a viewer that reads nothing for so long has hung
constexpr int poll_milliseconds = 100;
constexpr std::size_t band_bytes = std::size_t(1) << 20; // pixels of one message

struct Frame {
    int width = 0;
    int height = 0;
    std::vector<float> rgb; // interleaved
};

class Message {
public:
    enum class Operation : std::uint8_t { create_image = 4, update_image = 6 };

    explicit Message(Operation operation)
    {
        number(std::uint32_t(0)); // the length, filled in at the end
        number(operation);
    }
    template <class Number> Message& number(Number value)
    {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    Message& text(std::string_view value)
    {
        bytes_.append(value).push_back('\0');
        return *this;
    }
    Message& channel_names() { return text("R").text("G").text("B"); }
    Message& floats(const float* values, std::size_t count)
    {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(float));
        return *this;
    }
    const std::string& finished()
    {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return bytes_;
    }

private:
    std::string bytes_;
};

Message create_message(const std::string& name, const Frame& frame)
{
    Message message(Message::Operation::create_image);
    message.number(std::uint8_t(1)).text(name); // grabs the focus
    message.number(std::int32_t(frame.width)).number(std::int32_t(frame.height)).number(std::int32_t(3)).channel_names();
    return message;
}

// Rows [first, first + rows).
Message update_message(const std::string& name, const Frame& frame, int first, int rows)
{
    Message message(Message::Operation::update_image);
    message.number(std::uint8_t(0)).text(name).number(std::int32_t(3)).channel_names();
    message.number(std::int32_t(0)).number(std::int32_t(first)).number(std::int32_t(frame.width)).number(std::int32_t(rows));
    for (std::int64_t offset : {0, 1, 2}) message.number(offset);
    for (std::int64_t stride : {3, 3, 3}) message.number(stride);
    const std::size_t row_floats = static_cast<std::size_t>(frame.width) * 3;
    message.floats(frame.rgb.data() + static_cast<std::size_t>(first) * row_floats, static_cast<std::size_t>(rows) * row_floats);
    return message;
}

[[noreturn]] void fail(const std::string& what, int error) { throw std::runtime_error(what + ": " + std::strerror(error)); }

// A non-blocking connection; closed at the end. `abandoned` ends every wait.
class Connection {
public:
    Connection(const std::string& host, const std::string& port, const std::atomic<bool>& abandoned) : abandoned_(abandoned)
    {
        addrinfo hints = {};
        hints.ai_socktype = SOCK_STREAM;
        addrinfo* found = nullptr;
        if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found))
            throw std::runtime_error(std::string("cannot find the host: ") + ::gai_strerror(error));
        const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
        int error = 0;
        for (const addrinfo* address = found; address; address = address->ai_next)
            if ((error = try_connect(*address)) == 0) return;
        fail("cannot connect", error);
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection() { close(); }

    void send(std::string_view bytes) const
    {
        Timer stalled;
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent > 0) {
                bytes.remove_prefix(static_cast<std::size_t>(sent));
                stalled = Timer();
                continue;
            }
            if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) fail("the connection was lost", errno);
            if (abandoned_ || stalled.seconds() > stall_seconds) throw std::runtime_error("it does not read what it is sent");
            wait_until_writable();
        }
    }

    // tev never answers: what can be read is the end.
    void check_open() const
    {
        char byte;
        const ssize_t got = ::recv(socket_, &byte, 1, MSG_PEEK);
        if (got == 0) throw std::runtime_error("it has closed the connection");
        if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) fail("the connection was lost", errno);
    }

private:
    void close()
    {
        if (socket_ >= 0) ::close(socket_);
        socket_ = -1;
    }

    bool wait_until_writable() const
    {
        pollfd writable{socket_, POLLOUT, 0};
        return ::poll(&writable, 1, poll_milliseconds) > 0;
    }

    // The error, or 0.
    int try_connect(const addrinfo& address)
    {
        close();
        socket_ = ::socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol);
        if (socket_ < 0) return errno;
        if (::connect(socket_, address.ai_addr, address.ai_addrlen) == 0) return 0;
        if (errno != EINPROGRESS) return errno;
        const Timer timer;
        while (!wait_until_writable())
            if (abandoned_ || timer.seconds() > connect_seconds) return ETIMEDOUT;
        int error = 0;
        socklen_t size = sizeof error;
        return ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
    }

    const std::atomic<bool>& abandoned_;
    int socket_ = -1;
};

} // namespace

// What the caller and the thread share; the thread keeps it alive when the caller has given up.
struct TevViewer::Link {
    std::string host, port, name;
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<Frame> waiting;
    bool sending = true; // connecting counts
    bool closing = false; // nothing more will come
    bool ended = false;
    std::optional<std::string> problem;
    std::atomic<bool> abandoned{false};
    std::thread thread;

    std::optional<Frame> next_frame();
    void send_frames();
    void run();
};

std::optional<Frame> TevViewer::Link::next_frame()
{
    std::unique_lock lock(mutex);
    sending = false;
    changed.notify_all();
    changed.wait(lock, [&] { return waiting || closing; });
    sending = waiting.has_value();
    return std::exchange(waiting, std::nullopt);
}

void TevViewer::Link::send_frames()
{
    const Connection connection(host, port, abandoned);
    bool created = false;
    while (const std::optional<Frame> frame = next_frame()) {
        connection.check_open();
        if (!created) connection.send(create_message(name, *frame).finished());
        created = true;
        const int rows = std::max(1, static_cast<int>(band_bytes / (static_cast<std::size_t>(frame->width) * 3 * sizeof(float))));
        for (int first = 0; first < frame->height; first += rows)
            connection.send(update_message(name, *frame, first, std::min(rows, frame->height - first)).finished());
    }
}

void TevViewer::Link::run()
{
    std::optional<std::string> failure;
    try {
        send_frames();
    } catch (const std::exception& error) {
        failure = error.what();
    }
    const std::lock_guard lock(mutex);
    problem = failure;
    waiting.reset();
    sending = false;
    ended = true;
    changed.notify_all();
}

TevViewer::TevViewer(std::string host, std::string port, std::string image_name) : link_(std::make_shared<Link>())
{
    link_->host = std::move(host);
    link_->port = std::move(port);
    link_->name = std::move(image_name);
    link_->thread = std::thread([link = link_] { link->run(); });
}

TevViewer::~TevViewer() { finish(0.0); }

void TevViewer::show(const Image& image)
{
    const RgbChannels rgb = rgb_channels(image, link_->name);
    Frame frame{image.width, image.height, {}};
    frame.rgb.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int channel : {rgb.r, rgb.g, rgb.b}) frame.rgb.push_back(image.at(x, y, channel));
    const std::lock_guard lock(link_->mutex);
    if (link_->ended || link_->closing) return;
    link_->waiting = std::move(frame);
    link_->changed.notify_all();
}

bool TevViewer::busy() const
{
    const std::lock_guard lock(link_->mutex);
    return link_->sending || link_->waiting;
}

void TevViewer::finish(double seconds)
{
    if (!link_->thread.joinable()) return;
    std::unique_lock lock(link_->mutex);
    link_->closing = true;
    link_->changed.notify_all();
    const auto over = [&] { return link_->ended; };
    if (!link_->changed.wait_for(lock, std::chrono::duration<double>(seconds), over)) {
        link_->abandoned = true;
        // The thread looks at that every poll; only resolving a name takes longer, and is left to itself.
        link_->changed.wait_for(lock, std::chrono::milliseconds(3 * poll_milliseconds), over);
    }
    const bool ended = link_->ended;
    if (!ended) link_->problem = "it could not be reached in time";
    lock.unlock();
    if (ended) link_->thread.join();
    else link_->thread.detach();
}

std::optional<std::string> TevViewer::take_problem()
{
    const std::lock_guard lock(link_->mutex);
    return std::exchange(link_->problem, std::nullopt);
}

} // namespace sundog
