//! Conversion between file names and URIs.

use std::path::{Path, PathBuf, absolute};

use gen_lsp_types::Uri;

/// File name of a URI. A URI that does not refer to a file is itself used as the name of a file in the current folder.
pub fn path(uri: &Uri) -> PathBuf {
    let of_file = uri.0.strip_prefix("file://").and_then(|rest| rest.get(rest.find('/')?..));
    let Some(name) = of_file.and_then(decoded) else { return uri.0.replace('/', "_").into() };
    let is_of_drive = name.as_bytes().get(2) == Some(&b':');
    if is_of_drive { name[1..].into() } else { name.into() }
}

pub fn uri(path: &Path) -> Option<Uri> {
    let name = absolute(path).ok()?.to_str()?.replace('\\', "/");
    let mut text = String::from("file://");
    if !name.starts_with('/') {
        text.push('/');
    }
    for byte in name.bytes() {
        match byte {
            b'/' | b'-' | b'.' | b'_' | b'~' => text.push(char::from(byte)),
            _ if byte.is_ascii_alphanumeric() => text.push(char::from(byte)),
            _ => text.push_str(&format!("%{byte:02X}")),
        }
    }
    Some(Uri(text))
}

fn decoded(text: &str) -> Option<String> {
    let mut parts = text.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        bytes.push(u8::from_str_radix(part.get(..2)?, 16).ok()?);
        bytes.extend_from_slice(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).ok()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn file_paths_are_encoded_as_uris_and_decoded() {
        let file = Path::new("/tmp/ein Träger/50%.rhai");
        let of_file = uri(file).unwrap();
        assert_eq!(of_file.0, "file:///tmp/ein%20Tr%C3%A4ger/50%25.rhai");
        assert_eq!(path(&of_file), file);
        assert_eq!(path(&Uri("file://localhost/a.rhai".into())), Path::new("/a.rhai"));
        assert_eq!(path(&Uri("file:///c%3A/a.rhai".into())), Path::new("c:/a.rhai"));
        for strange in
            ["untitled:Untitled-1", "", "file://", "file:///%", "file:///%zz", "file:///%ff"]
        {
            assert!(path(&Uri(strange.into())).is_relative(), "{strange}");
        }
    }
}
