use serde_json::Value;

/// JSON of an object whose keys keep their order, with a list of numbers on one line, and a line end behind it.
pub(super) fn object(fields: &[(&str, Value)]) -> String {
    let mut text = String::new();
    block(['{', '}'], fields.iter().map(|(key, item)| (Some(*key), item)), 0, &mut text);
    text.push('\n');
    text
}

/// Appends a value, a list of numbers on one line.
fn lay_out(value: &Value, indent: usize, text: &mut String) {
    match value {
        Value::Object(map) => {
            block(['{', '}'], map.iter().map(|(key, item)| (Some(key.as_str()), item)), indent, text);
        }
        Value::Array(items) if !items.iter().all(Value::is_number) => {
            block(['[', ']'], items.iter().map(|item| (None, item)), indent, text);
        }
        Value::Array(items) => {
            let numbers: Vec<String> = items.iter().map(number).collect();
            text.push_str(&format!("[{}]", numbers.join(", ")));
        }
        _ => text.push_str(&number(value)),
    }
}

fn block<'a>(
    [open, close]: [char; 2],
    items: impl Iterator<Item = (Option<&'a str>, &'a Value)>,
    indent: usize,
    text: &mut String,
) {
    let new_line = |text: &mut String, indent: usize| {
        text.push('\n');
        text.extend(std::iter::repeat_n(' ', indent));
    };
    text.push(open);
    for (i, (key, item)) in items.enumerate() {
        if i > 0 {
            text.push(',');
        }
        new_line(text, indent + 1);
        if let Some(key) = key {
            text.push_str(&format!("\"{key}\": "));
        }
        lay_out(item, indent + 1, text);
    }
    new_line(text, indent);
    text.push(close);
}

/// A value that is no list or object; what came from a 32-bit float has no more digits than one needs.
fn number(value: &Value) -> String {
    match value.as_f64() {
        Some(v) if value.is_f64() && f64::from(v as f32) == v => format!("{:?}", v as f32),
        _ => value.to_string(),
    }
}
