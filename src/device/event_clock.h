// Whether the times that a driver's events tell are seconds. Some drivers count in other units, or give each command of a batch the time
// of all of them; no figures are better than wrong ones.
#pragma once

namespace sundog
{

// Compares the clock of a device with that of the host. All times in seconds.
class EventClock
{
public:
    // A command ended at `device` by its event, and the host, which waited for it, went on at `host`.
    void start(double device, double host)
    {
        device_start_ = device;
        host_start_ = host;
    }

    // The same for a later command; busy: the time that all commands since then took together, one after the other. Times are seconds
    // if both clocks went as fast, as far as so short a time can tell, and if the device was not busy for longer than there was time.
    bool tells_seconds(double device, double host, double busy) const
    {
        const double passed = host - host_start_, ticked = device - device_start_;
        if (busy > passed * (1.0 + tolerance) + lateness) return false;
        return passed < shortest || (ticked >= passed * (1.0 - tolerance) && ticked <= passed * (1.0 + tolerance));
    }

private:
    static constexpr double lateness = 0.1; // of a host that has much else to do
    static constexpr double shortest = 0.5;
    static constexpr double tolerance = 0.2;
    double device_start_ = 0.0, host_start_ = 0.0;
};

} // namespace sundog
