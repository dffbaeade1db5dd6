//! The certificate of the server.

use crate::failure::Failure;
use crate::read;
use std::path::Path;
use std::sync::Arc;
use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::ServerConfig;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};

/// Reads a chain of certificates and a key, both in PEM.
pub(super) fn acceptor(certificate: &Path, key: &Path) -> Result<TlsAcceptor, Failure> {
    let refused =
        |path: &Path, why: &dyn std::fmt::Display| Failure::file("use", path, &std::io::Error::other(why.to_string()));
    let text = |path: &Path| read::whole(path).map_err(|error| Failure::file("read", path, &error));
    let chain: Vec<CertificateDer<'static>> = CertificateDer::pem_slice_iter(&text(certificate)?)
        .collect::<Result<_, _>>()
        .map_err(|error| refused(certificate, &error))?;
    let secret = PrivateKeyDer::from_pem_slice(&text(key)?).map_err(|error| refused(key, &error))?;
    let config = ServerConfig::builder_with_provider(Arc::new(ring::default_provider()))
        .with_safe_default_protocol_versions()
        .and_then(|config| config.with_no_client_auth().with_single_cert(chain, secret))
        .map_err(|error| refused(certificate, &error))?;
    Ok(TlsAcceptor::from(Arc::new(config)))
}
