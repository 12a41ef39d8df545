#pragma once
// A JSON schema validator for what results.schema.json uses. A keyword it does not know is an error, not a pass.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::command::schema {

using nlohmann::json;

class Validator {
  public:
    explicit Validator(json root) : root_(std::move(root)) {}

    /// Every rule that `document` breaks, as "where: what"; none for a valid document.
    [[nodiscard]] std::vector<std::string> errors(json const& document) {
        errors_.clear();
        check(root_, document, "$");
        return errors_;
    }

  private:
    void complain(std::string const& where, std::string const& what) { errors_.push_back(where + ": " + what); }

    static bool has_type(json const& value, std::string const& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "number") return value.is_number();
        if (type == "integer")
            return value.is_number_integer() ||
                   (value.is_number_float() && std::floor(value.get<double>()) == value.get<double>());
        if (type == "boolean") return value.is_boolean();
        return type == "null" && value.is_null();
    }

    void check_type(json const& types, json const& value, std::string const& where) {
        json const list = types.is_array() ? types : json::array({types});
        for (json const& type : list)
            if (has_type(value, type.get<std::string>())) return;
        complain(where, "is not of type " + types.dump());
    }

    void check_object(json const& schema, json const& value, std::string const& where) {
        for (json const& name : schema.value("required", json::array()))
            if (!value.contains(name.get<std::string>())) complain(where, "lacks " + name.dump());
        json const dependent = schema.value("dependentRequired", json::object());
        for (auto const& [name, others] : dependent.items())
            for (json const& other : others)
                if (value.contains(name) && !value.contains(other.get<std::string>())) complain(where, "lacks " + other.dump());
        json const properties = schema.value("properties", json::object());
        for (auto const& [name, field] : value.items()) {
            std::string const inner = where + '.' + name;
            if (properties.contains(name))
                check(properties.at(name), field, inner);
            else if (schema.contains("additionalProperties"))
                check(schema.at("additionalProperties"), field, inner);
        }
    }

    void check_scalar(std::string const& keyword, json const& rule, json const& value, std::string const& where) {
        if (keyword == "enum" && std::find(rule.begin(), rule.end(), value) == rule.end())
            complain(where, value.dump() + " is not one of " + rule.dump());
        if (keyword == "minimum" && value.is_number() && !(value.get<double>() >= rule.get<double>()))
            complain(where, value.dump() + " is below " + rule.dump());
        if (keyword == "maximum" && value.is_number() && !(value.get<double>() <= rule.get<double>()))
            complain(where, value.dump() + " is above " + rule.dump());
        if (keyword == "minLength" && value.is_string() && value.get<std::string>().size() < rule.get<std::size_t>())
            complain(where, "is too short");
    }

    void check(json const& schema, json const& value, std::string const& where) {
        if (schema.is_boolean()) {
            if (!schema.get<bool>()) complain(where, "is not allowed");
            return;
        }
        static std::vector<std::string> const known = {"$schema",  "$id",         "$defs",
                                                       "title",    "description", "type",
                                                       "required", "properties",  "additionalProperties",
                                                       "items",    "enum",        "minimum",
                                                       "maximum",  "minLength",   "$ref",
                                                       "dependentRequired"};
        for (auto const& [keyword, rule] : schema.items()) {
            if (std::find(known.begin(), known.end(), keyword) == known.end())
                complain(where, "the schema uses the unknown keyword " + keyword);
            if (keyword == "$ref") check(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, where);
            if (keyword == "type") check_type(rule, value, where);
            check_scalar(keyword, rule, value, where);
        }
        if (value.is_object()) check_object(schema, value, where);
        if (value.is_array() && schema.contains("items"))
            for (std::size_t i = 0; i < value.size(); ++i)
                check(schema.at("items"), value[i], where + '[' + std::to_string(i) + ']');
    }

    json root_;
    std::vector<std::string> errors_;
};

}  // namespace gnomon::command::schema
