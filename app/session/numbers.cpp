#include "app/session/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace ramus::app {

std::string grouped(std::uint64_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(',');
        text.push_back(digits[i]);
    }
    return text;
}

std::string exact_text(double value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string rounded(double number) {
    char text[32];
    // Four digits, but all digits of integers.
    std::snprintf(text, sizeof text, std::abs(number) >= 1e4 ? "%.0f" : "%.4g", number);
    return text;
}

std::string digits(double value, int significant) {
    if (value == 0.0 || !std::isfinite(value)) return value == 0.0 ? "0" : "?";
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
    if (std::abs(value) >= 999.5)
        return std::string(value < 0.0 ? "-" : "")
            .append(grouped(static_cast<std::uint64_t>(std::llround(std::abs(value)))));
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", std::clamp(significant - 1 - magnitude, 0, 9), value);
    return text;
}

std::string Lengths::text(double length, int significant) const {
    return length < 999.5 || !known() ? digits(length, significant) + " " + unit()
                                      : digits(length / 1000.0, significant) + " m";
}

std::string Lengths::range(double least, double most) const {
    const std::string a = digits(least), b = digits(most);
    return (a == b ? a : a + " \xE2\x80\x93 " + b) + " " + unit();
}

std::string Lengths::area(double area) const { return digits(area) + " " + unit() + "\xC2\xB2"; }

std::string Lengths::volume(double volume) const {
    return volume < 999.5 || !known() ? digits(volume) + " " + unit() + "\xC2\xB3" : digits(volume / 1000.0) + " ml";
}

std::string seconds_text(double seconds) {
    return seconds < 0.9995 ? digits(1000.0 * seconds, 2) + " ms" : digits(seconds) + " s";
}

std::vector<double> round_numbers(double low, double high, bool logarithmic) {
    std::vector<double> found;
    if (logarithmic) {
        // Over many decades only powers of ten, or some of them.
        const double decades = std::log10(high / low);
        const int stride = std::max(1, static_cast<int>(std::ceil(decades / 10.0)));
        for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= std::log10(high); decade += stride)
            for (const double step : {1.0, 2.0, 5.0})
                if (step > 1.0 && decades > 3.5)
                    break;
                else if (const double v = step * std::pow(10.0, decade); v >= low * 0.999 && v <= high * 1.001)
                    found.push_back(v);
        return found;
    }
    if (!(high > low)) return {low};
    const double rough = (high - low) / 5.0, power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = power * (rough <= 1.0 * power   ? 1.0
                                 : rough <= 2.0 * power ? 2.0
                                 : rough <= 5.0 * power ? 5.0
                                                        : 10.0);
    for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n += 1.0)
        found.push_back(n * step + 0.0); // no negative zero
    return found;
}

std::string local_time_text(std::chrono::system_clock::time_point time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm local{};
    char text[64] = "";
    if (::localtime_r(&seconds, &local) != nullptr) std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

std::string counted(std::uint64_t number, const std::string& one, const std::string& many) {
    return grouped(number) + " " + (number == 1 ? one : many);
}

std::string over_text(double limit_mm, const Lengths& lengths) { return "over " + lengths.text(limit_mm); }

std::string amount_text(const measure::Amount& amount, const Lengths& lengths) {
    return counted(static_cast<std::uint64_t>(amount.branches), "branch", "branches") + ", " +
           lengths.text(amount.length_mm) + ", " + lengths.volume(amount.volume_mm3) + " of vessel volume, " +
           counted(static_cast<std::uint64_t>(amount.leaves), "leaf", "leaves");
}

} // namespace ramus::app
