// SPDX-License-Identifier: MIT
const auto value = nlohmann::json::parse(text);
