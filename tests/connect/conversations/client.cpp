// What AdsLib says, to be recorded: client port

#include "AdsLib.h"
#include "AdsNotificationOOI.h"
#include "AdsVariable.h"

#include <array>
#include <cstdint>
#include <string>

namespace
{
constexpr uint32_t SUM_READ = 0xF080;
constexpr uint32_t SUM_WRITE = 0xF081;
constexpr uint32_t NOTHING = 0xDEAD;
constexpr uint16_t PLC = 851;
constexpr uint16_t SYSTEM = 10000;

void told(const AmsAddr *, const AdsNotificationHeader *, uint32_t)
{
}

void sums(const AdsDevice &plc)
{
	const auto count = plc.GetHandle("GVL.Count");
	const uint32_t group = ADSIGRP_SYM_VALBYHND, size = 4;
	const std::array<uint32_t, 6> reads{ group, *count, size, NOTHING, 0, size };
	std::array<uint32_t, 4> values{};
	uint32_t length = 0;
	plc.ReadWriteReqEx2(SUM_READ, 2, sizeof values, values.data(), sizeof reads, reads.data(), &length);
	const std::array<uint32_t, 4> write{ group, *count, size, 9 };
	uint32_t result = 0;
	plc.ReadWriteReqEx2(SUM_WRITE, 1, sizeof result, &result, sizeof write, write.data(), &length);
}
}

int main(int, char **arguments)
{
	const std::string address = std::string{ "127.0.0.1:" } + arguments[1];
	const AmsNetId server{ 127, 0, 0, 1, 1, 1 };
	const AdsDevice plc{ address, server, PLC };
	const AdsDevice service{ address, server, SYSTEM };
	plc.GetDeviceInfo();
	plc.GetState();
	service.GetState();

	AdsVariable<int32_t> count{ plc, "GVL.Count" };
	count = 77;
	static_cast<void>(static_cast<int32_t>(count));
	AdsVariable<double> inner{ plc, "GVL.Inners[1].rValue" };
	inner = 1.5;
	static_cast<void>(static_cast<double>(inner));
	const AdsVariable<std::array<double, 4>> shown{ plc, "GVL.Shown" };
	static_cast<void>(static_cast<std::array<double, 4>>(shown));
	sums(plc);
	{
		const AdsNotificationAttrib onChange{ sizeof(int32_t), ADSTRANS_SERVERONCHA, 0, { 0 } };
		const AdsNotification watch{ plc, "GVL.Count", onChange, &told, 0 };
		for (int32_t value = 0; value < 5; ++value)
			count = value;
	}
	try {
		const AdsVariable<int32_t> nothing{ plc, "GVL.Nothing" };
	} catch (const AdsException &) {
		plc.SetState(ADSSTATE_STOP, ADSSTATE_INVALID);
	}
	return 0;
}
