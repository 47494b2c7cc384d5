//! The stores of tables: the files of this machine, and buckets of S3 or of stores with its protocol.

use std::sync::Arc;

use datafusion::error::{DataFusionError, Result};
use datafusion::execution::object_store::{DefaultObjectStoreRegistry, ObjectStoreRegistry};
use object_store::ObjectStore;
use object_store::aws::AmazonS3Builder;
use url::Url;

use crate::error::Error;

/// The stores of a process. A bucket is opened when a query first names it. Its keys and endpoint come from the
/// environment (`AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_SESSION_TOKEN`, `AWS_REGION`, `AWS_ENDPOINT_URL`
/// and, for an endpoint without TLS, `AWS_ALLOW_HTTP=true`).
#[derive(Debug, Default)]
pub(super) struct Stores {
    known: DefaultObjectStoreRegistry,
}

impl ObjectStoreRegistry for Stores {
    fn register_store(
        &self,
        url: &Url,
        store: Arc<dyn ObjectStore>,
    ) -> Option<Arc<dyn ObjectStore>> {
        self.known.register_store(url, store)
    }

    fn deregister_store(&self, url: &Url) -> Result<Arc<dyn ObjectStore>> {
        self.known.deregister_store(url)
    }

    fn get_store(&self, url: &Url) -> Result<Arc<dyn ObjectStore>> {
        let bucket = match (url.scheme(), url.host_str()) {
            ("s3", Some(bucket)) => bucket,
            _ => return self.known.get_store(url),
        };
        if let Ok(store) = self.known.get_store(url) {
            return Ok(store);
        }
        let built = AmazonS3Builder::from_env().with_bucket_name(bucket).build();
        let store: Arc<dyn ObjectStore> =
            Arc::new(built.map_err(|error| failed(bucket, &error.to_string()))?);
        self.known.register_store(url, store.clone());
        Ok(store)
    }
}

fn failed(bucket: &str, reason: &str) -> DataFusionError {
    let reason = format!(
        "s3://{bucket}: {reason}; keys and endpoint come from the environment, as AWS_ACCESS_KEY_ID, \
         AWS_SECRET_ACCESS_KEY, AWS_REGION and AWS_ENDPOINT_URL"
    );
    Error::Query(reason).into()
}
