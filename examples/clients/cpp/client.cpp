// An ADS client in C++, with Beckhoff's AdsLib: it switches an axis on by the motion layer and moves it by the NC port.
//
// With AdsLib from github.com/Beckhoff/ADS beside this file, and g++, clang++ or "python -m ziglang c++" as CXX:
//
//   $CXX -std=c++14 -DCONFIG_DEFAULT_LOGLEVEL=1 -I ADS/AdsLib -pthread -o client client.cpp ADS/AdsLib/{,standalone/}*.cpp
//   ./client [host[:port]]

#include "AdsLib.h"
#include "AdsNotificationOOI.h"
#include "AdsVariable.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{
constexpr uint16_t PLC = 851;
constexpr uint16_t NC = 501;
constexpr uint16_t ENABLE = 3;
constexpr uint16_t DONE = 10000;

constexpr uint32_t AXIS = 1;
constexpr uint32_t STATE_GROUP = 0x4100 + AXIS;
constexpr uint32_t FUNCTION_GROUP = 0x4200 + AXIS;
constexpr uint32_t SET_POSITION = 0x0A;
constexpr uint32_t NEW_END_POSITION = 0x11;

// What the function "new end position" takes.
struct EndPosition {
	uint32_t kind;
	uint32_t reserved;
	double position;
};

// The last value of something that is watched; notifications come in a thread of AdsLib.
template <typename T> class Watched {
public:
	void set(T value)
	{
		const std::lock_guard<std::mutex> lock{ mutex };
		last = value;
		changed.notify_all();
	}

	template <typename Wanted> void until(Wanted wanted)
	{
		std::unique_lock<std::mutex> lock{ mutex };
		if (!changed.wait_for(lock, std::chrono::seconds{ 20 }, [&] { return wanted(last); }))
			throw std::runtime_error("waited for 20 s in vain");
	}

private:
	std::mutex mutex;
	std::condition_variable changed;
	T last{};
};

Watched<uint16_t> state;
Watched<double> position;

template <typename T, Watched<T> &watched>
void told(const AmsAddr *, const AdsNotificationHeader *notification, uint32_t)
{
	T value{};
	std::memcpy(&value, notification + 1, sizeof value);
	watched.set(value);
}

template <typename T> AdsNotificationAttrib onChange()
{
	return { sizeof(T), ADSTRANS_SERVERONCHA, 0, { 0 } };
}
}

void move(const std::string &address)
{
	const AmsNetId server{ 127, 0, 0, 1, 1, 1 };
	const AdsDevice plc{ address, server, PLC };
	const AdsDevice nc{ address, server, NC };

	const AdsVariable<uint16_t> start{ plc, "MAIN_AXIS.eInit" };
	while (static_cast<uint16_t>(start) != DONE)
		std::this_thread::sleep_for(std::chrono::milliseconds{ 10 });

	AdsVariable<uint16_t> command{ plc, "GVL_AXIS.Ctrl[1].eCmd" };
	AdsVariable<double> velocity{ plc, "GVL_AXIS.Data[1].rSetVelo" };
	velocity = 400.0;
	std::printf("velocity %.1f\n", static_cast<double>(velocity));

	{
		const AdsNotification watch{ plc, "GVL_AXIS.State[1].eState", onChange<uint16_t>(), &told<uint16_t, state>, 0 };
		command = ENABLE;
		state.until([](uint16_t now) { return now == ENABLE + DONE; });
	}
	const AdsNotification watch{ nc, STATE_GROUP, SET_POSITION, onChange<double>(), &told<double, position>, 0 };
	for (const double target : { 100.0, 250.0, 0.0 }) {
		const EndPosition end{ 1, 0, target };
		const auto refused = nc.WriteReqEx(FUNCTION_GROUP, NEW_END_POSITION, sizeof end, &end);
		if (refused)
			throw AdsException{ refused };
		position.until([target](double now) { return now == target; });
		std::printf("position %.2f\n", target);
	}
}

int main(int count, char **arguments)
{
	const std::string address = count > 1 ? arguments[1] : "127.0.0.1";
	try {
		move(address);
	} catch (const AdsException &error) {
		std::fprintf(stderr, "%s: ADS error 0x%X\n", address.c_str(), static_cast<unsigned>(error.errorCode));
		return 1;
	} catch (const std::exception &error) {
		std::fprintf(stderr, "%s: %s\n", address.c_str(), error.what());
		return 1;
	}
	return 0;
}
